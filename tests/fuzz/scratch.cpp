#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

/// Called by libFuzzer before it reads its arguments. Where folders of seeds are given, puts the folder PROGRAM.units
/// before them, because new units are written to the first one, and sends what crashes there too.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  namespace fs = std::filesystem;
  static std::vector<std::string> texts;
  static std::vector<char*> pointers;
  const std::vector<std::string> given(*argv + 1, *argv + *argc);
  const bool has_seeds =
      std::any_of(given.begin(), given.end(), [](const std::string& a) { return fs::is_directory(a); });
  const bool merges =
      std::any_of(given.begin(), given.end(), [](const std::string& a) { return a.starts_with("-merge"); });
  if (!has_seeds || merges) return 0;

  const std::string program = (*argv)[0], units = program + ".units/";
  fs::create_directories(units);
  texts = {program, "-artifact_prefix=" + units};
  texts.insert(texts.end(), given.begin(), given.end());
  const auto first_folder =
      std::find_if(texts.begin() + 1, texts.end(), [](const std::string& a) { return a[0] != '-'; });
  texts.insert(first_folder, units);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  *argc = static_cast<int>(texts.size());
  *argv = pointers.data();
  return 0;
}

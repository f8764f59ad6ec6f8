#include "isophote/load/messages.h"

namespace isophote {

std::string one_line(std::string_view text) {
  constexpr std::size_t longest = 400;
  std::string line(text);
  if (line.size() > longest) line = line.substr(0, longest / 2) + " ... " + line.substr(line.size() - longest / 2);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return line;
}

std::string place_name(std::string_view array, std::size_t index, const std::string& name) {
  std::string place = std::string(array) + "[" + std::to_string(index) + "]";
  if (!name.empty()) place += " \"" + name + "\"";
  return place;
}

}  // namespace isophote

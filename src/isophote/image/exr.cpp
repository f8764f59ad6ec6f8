#include "isophote/image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "isophote/core/atomic_file.h"
#include "isophote/core/check.h"
#include "isophote/core/error.h"
#include "isophote/image/exr_header.h"

namespace isophote {
namespace {

constexpr int this_thread_only = 0;

std::string channel_name(const std::string& layer, char suffix) {
  return layer.empty() ? std::string(1, suffix) : layer + "." + suffix;
}

/// The three channels of a layer, or nothing.
std::vector<const ExrFile::Channel*> find_triple(const ExrFile& file, const std::string& layer) {
  for (const char* suffixes : {"RGB", "XYZ"}) {
    std::vector<const ExrFile::Channel*> found;
    for (int i = 0; i < 3; ++i)
      if (const auto* channel = file.find(channel_name(layer, suffixes[i]))) found.push_back(channel);
    if (found.size() == 3) return found;
  }
  return {};
}

Imf::Slice slice(const ExrFile::Channel& channel, const Imath::Box2i& window) {
  return Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window);
}

ExrFile read_pixels(Imf::InputFile& input) {
  const Imath::Box2i window = input.header().dataWindow();
  ExrFile file;
  file.width = window.max.x - window.min.x + 1;
  file.height = window.max.y - window.min.y + 1;
  const auto& channels = input.header().channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      throw UserError(std::string("channel '") + c.name() + "' is subsampled, which is not supported");
    file.channels.push_back({c.name(), {}});
  }
  Imf::FrameBuffer buffer;
  for (ExrFile::Channel& channel : file.channels) {
    channel.values.resize(static_cast<std::size_t>(file.width) * file.height);
    buffer.insert(channel.name, slice(channel, window));
  }
  input.setFrameBuffer(buffer);
  input.readPixels(window.min.y, window.max.y);
  return file;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

const ExrFile::Channel* ExrFile::find(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

void ExrFile::add(const std::string& name, std::vector<float> values) {
  ISOPHOTE_CHECK(values.size(), ==, static_cast<std::size_t>(width) * height);
  ISOPHOTE_CHECK(find(name), ==, nullptr);
  channels.push_back({name, std::move(values)});
}

void ExrFile::add_rgb(const std::string& layer, const RgbImage& image, const char* suffixes) {
  for (int i = 0; i < 3; ++i) {
    std::vector<float> values;
    values.reserve(image.pixels.size());
    for (const Rgb& c : image.pixels) values.push_back(c[i]);
    add(channel_name(layer, suffixes[i]), std::move(values));
  }
}

RgbImage ExrFile::rgb(const std::string& layer) const {
  const auto triple = find_triple(*this, layer);
  if (triple.empty()) {
    std::string known;
    for (const std::string& name : layers()) known += (known.empty() ? "" : ", ") + (name.empty() ? "R,G,B" : name);
    throw UserError((layer.empty() ? "no channels R,G,B" : "no layer '" + layer + "'") + std::string("; there is: ") +
                    (known.empty() ? "no layer of three channels" : known));
  }
  RgbImage image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {triple[0]->values[i], triple[1]->values[i], triple[2]->values[i]};
  return image;
}

std::vector<std::string> ExrFile::layers() const {
  std::vector<std::string> names;
  for (const Channel& channel : channels) {
    const auto dot = channel.name.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.name.substr(0, dot);
    if (!find_triple(*this, layer).empty()) names.push_back(layer);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

ExrFile read_exr(const std::string& path) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw UserError(path + ": cannot read: " + failure.message());
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw UserError(path + ": cannot read: cannot be opened");
  try {
    check_exr_header(stream, size);
    stream.clear();
    stream.seekg(0);
    Imf::StdIFStream exr_stream(stream, path.c_str());
    Imf::InputFile input(exr_stream, this_thread_only);
    return read_pixels(input);
  } catch (const std::bad_alloc&) {
    throw UserError(path + ": cannot read EXR: it does not fit in memory");
  } catch (const std::exception& error) {
    throw UserError(path + ": cannot read EXR: " + first_line(error.what()));
  }
}

void write_exr(const std::string& path, const ExrFile& file) {
  ISOPHOTE_CHECK(file.width, >, 0);
  ISOPHOTE_CHECK(file.height, >, 0);
  AtomicFile output(path);
  try {
    Imf::Header header(file.width, file.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    for (const ExrFile::Channel& channel : file.channels) {
      header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
      buffer.insert(channel.name, slice(channel, header.dataWindow()));
    }
    Imf::StdOFStream exr_stream(output.stream(), path.c_str());
    Imf::OutputFile exr(exr_stream, header, this_thread_only);
    exr.setFrameBuffer(buffer);
    exr.writePixels(file.height);
  } catch (const std::exception& error) {
    throw UserError(path + ": cannot write EXR: " + first_line(error.what()));
  }
  output.commit();
}

}  // namespace isophote

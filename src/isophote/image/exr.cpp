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

/// The same, which must be there.
std::vector<const ExrFile::Channel*> require_triple(const ExrFile& file, const std::string& layer) {
  const auto triple = find_triple(file, layer);
  if (!triple.empty()) return triple;
  std::string known;
  for (const std::string& name : file.layers()) known += (known.empty() ? "" : ", ") + (name.empty() ? "R,G,B" : name);
  throw UserError((layer.empty() ? "no channels R,G,B" : "no layer '" + layer + "'") + std::string("; there is: ") +
                  (known.empty() ? "no layer of three channels" : known));
}

/// What is in the file, without its values.
ExrFile read_names(const Imf::InputFile& input) {
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
  return file;
}

void read_pixels(Imf::InputFile& input, const Imf::FrameBuffer& buffer) {
  const Imath::Box2i window = input.header().dataWindow();
  input.setFrameBuffer(buffer);
  input.readPixels(window.min.y, window.max.y);
}

/// What a reader may allocate, and what it is about to.
struct Allowance {
  std::uint64_t memory, needed = 0;

  void take(std::uint64_t bytes) {
    needed += bytes;
    constexpr std::uint64_t mebi = 1 << 20;
    if (needed > memory)
      throw UserError("it does not fit in memory: needs " + std::to_string((needed + mebi - 1) / mebi) +
                      " MiB, there are " + std::to_string(memory / mebi));
  }
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Calls body(input, names, pixels, allowance) for an open file whose header has been checked.
template <class Body>
auto read_with(const std::string& path, std::uint64_t memory, const Body& body) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw UserError(path + ": cannot read: " + failure.message());
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw UserError(path + ": cannot read: cannot be opened");
  try {
    const ExrClaim claim = check_exr_header(stream, size);
    Allowance allowance{memory};
    allowance.take(claim.buffers);
    stream.clear();
    stream.seekg(0);
    Imf::StdIFStream exr_stream(stream, path.c_str());
    Imf::InputFile input(exr_stream, this_thread_only);
    return body(input, read_names(input), claim.pixels, allowance);
  } catch (const std::bad_alloc&) {
    throw UserError(path + ": cannot read EXR: it does not fit in memory");
  } catch (const std::exception& error) {
    throw UserError(path + ": cannot read EXR: " + first_line(error.what()));
  }
}

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
  const auto triple = require_triple(*this, layer);
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

ExrFile read_exr(const std::string& path, std::uint64_t memory) {
  return read_with(path, memory, [](Imf::InputFile& input, ExrFile file, std::uint64_t pixels, Allowance allowance) {
    allowance.take(pixels * file.channels.size() * sizeof(float));
    Imf::FrameBuffer buffer;
    for (ExrFile::Channel& channel : file.channels) {
      channel.values.resize(pixels);
      buffer.insert(channel.name, slice(channel, input.header().dataWindow()));
    }
    read_pixels(input, buffer);
    return file;
  });
}

RgbImage read_exr_layer(const std::string& path, const std::string& layer, std::uint64_t memory) {
  return read_with(path, memory, [&](Imf::InputFile& input, const ExrFile& file, std::uint64_t pixels, Allowance left) {
    const auto triple = require_triple(file, layer);
    left.take(pixels * sizeof(Rgb));
    RgbImage image(file.width, file.height);
    float* const first[] = {&image.pixels[0].r, &image.pixels[0].g, &image.pixels[0].b};
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < 3; ++i)
      buffer.insert(triple[i]->name, Imf::Slice::Make(Imf::FLOAT, first[i], input.header().dataWindow(), sizeof(Rgb)));
    read_pixels(input, buffer);
    return image;
  });
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

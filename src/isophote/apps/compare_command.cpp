#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "isophote/apps/commands.h"
#include "isophote/apps/output_files.h"
#include "isophote/core/error.h"
#include "isophote/image/exr.h"
#include "isophote/image/false_colour.h"
#include "isophote/image/metrics.h"
#include "isophote/image/png.h"

namespace isophote::app {
namespace {

/// The layers and the channels that `layer_of` takes.
std::string what_there_is(const ExrFile& file) {
  const std::vector<std::string> colours = file.layers();
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  for (const std::string& layer : colours) add(layer.empty() ? "R,G,B" : layer);
  for (const ExrFile::Channel& channel : file.channels) {
    const auto dot = channel.name.rfind('.');
    const std::string layer = dot == std::string::npos ? "" : channel.name.substr(0, dot);
    const std::string last = dot == std::string::npos ? channel.name : channel.name.substr(dot + 1);
    const bool in_layer = last.size() == 1 && std::string_view("RGBXYZ").find(last) != std::string_view::npos;
    if (!in_layer || std::find(colours.begin(), colours.end(), layer) == colours.end()) add(channel.name);
  }
  return names;
}

/// A layer of colours; or one of a single channel, as grey: `depth.Z`, or `depth` for short.
RgbImage layer_of(const ExrFile& file, const std::string& layer) {
  const std::vector<std::string> colours = file.layers();
  if (std::find(colours.begin(), colours.end(), layer) != colours.end()) return file.rgb(layer);
  for (const char* suffix : {"", ".Z", ".Y"})
    if (const ExrFile::Channel* channel = file.find(layer + suffix)) {
      RgbImage image(file.width, file.height);
      for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(channel->values[i]);
      return image;
    }
  throw UserError(fmt::format("no layer '{}'; there is: {}", layer.empty() ? "R,G,B" : layer, what_there_is(file)));
}

RgbImage read_layer(const std::string& path, const std::string& layer, int block) {
  const ExrFile file = read_exr(path);
  try {
    const RgbImage image = layer_of(file, layer);
    return block > 1 ? block_average(image, block) : image;
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", path, error.what()));
  }
}

void check_files(const CompareRequest& request) {
  if (request.error_picture.empty()) return;
  const std::array outputs{NamedFile{"--error-picture " + request.error_picture, request.error_picture}};
  require_png(outputs[0]);
  const std::array inputs{NamedFile{"the picture", request.image}, NamedFile{"the reference", request.reference},
                          NamedFile{"the reference of --second", request.second},
                          NamedFile{"the picture of --other", request.other}};
  check_kept(inputs, outputs);
}

}  // namespace

int compare(const CompareRequest& request) {
  if (const auto& limit = request.fail_above; limit && !(*limit >= 0 && std::isfinite(*limit)))
    throw UsageError(fmt::format("--fail-above: wants a number from 0, not '{:g}'", *limit));
  check_files(request);
  const RgbImage image = read_layer(request.image, request.layer, request.block);
  const RgbImage reference = read_layer(request.reference, request.layer, request.block);
  const RgbImage second = request.second.empty() ? reference : read_layer(request.second, request.layer, request.block);
  const RgbImage other = request.other.empty() ? image : read_layer(request.other, request.layer, request.block);
  const Difference d = isophote::compare(image, other, reference, second);
  if (!request.error_picture.empty()) write_png(request.error_picture, error_picture(image, reference, 0.2f), 0);
  if (request.json) {
    const nlohmann::ordered_json json = {
        {"rmse", d.rmse}, {"relative_rmse", d.relative_rmse}, {"relative_mse", d.relative_mse},
        {"bias", d.bias}, {"block_error", d.block_error},     {"ssim", d.ssim}};
    fmt::print("{}\n", json.dump());
  } else {
    fmt::print("RMSE            {:.6g}  ({:.3f}% of the reference's mean)\n", d.rmse, 100 * d.relative_rmse);
    fmt::print("relative MSE    {:.6g}\n", d.relative_mse);
    fmt::print("bias            {:+.3f}%\n", 100 * d.bias);
    fmt::print("{:<15} {:.3f}%\n", fmt::format("{0}x{0}-block error", 8 * request.block), 100 * d.block_error);
    fmt::print("SSIM            {:.5f}\n", d.ssim);
  }
  const bool failed = request.fail_above && !(d.relative_rmse <= *request.fail_above);
  if (failed)
    fmt::print(stderr, "isophote: relative RMSE {:.4g} is above {:.4g}\n", d.relative_rmse, *request.fail_above);
  return failed ? 1 : 0;
}

}  // namespace isophote::app

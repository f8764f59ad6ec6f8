#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "isophote/apps/commands.h"
#include "isophote/core/error.h"

namespace {

using namespace isophote;

/// What all verbs share that work on a scene.
void add_scene(CLI::App* verb, app::SceneRequest& request) {
  verb->add_option("scene", request.scene, "scene file")->type_name("FILE")->required();
  for (const app::Option& option : app::options()) {
    const std::string name(option.name);
    verb->add_option_function<std::string>(
            "--" + name, [&request, name](const std::string& value) { request.settings.emplace_back(name, value); },
            std::string(option.help))
        ->type_name(std::string(option.values));
  }
  verb->add_option("--threads", request.threads, "worker threads (default: all)")
      ->type_name("N")
      ->check(CLI::Range(0, 1024).description(""));
  verb->add_option("--progress", request.progress,
                   "how far the work is, on standard error (default: bar on a terminal)")
      ->type_name("bar|json|none")
      ->check(CLI::IsMember({"bar", "json", "none"}).description(""));
  verb->add_option("--load-cache", request.load_cache, "start with these records")->type_name("FILE");
}

void add_render(CLI::App& program, app::RenderRequest& request) {
  CLI::App* verb = program.add_subcommand("render", "Render a scene (.glb, .gltf or .toml)");
  verb->add_option("-o,--output", request.outputs, "picture: .exr (all layers) or .png; may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_scene(verb, request);
  verb->add_option("--stats", request.stats, "write statistics as JSON")->type_name("FILE");
  verb->add_option("--preview", request.preview, "rewrite this PNG from coarse to fine while working")
      ->type_name("FILE");
  verb->add_option("--show-records", request.records_picture, "write a PNG of the records and their footprints")
      ->type_name("FILE");
  verb->add_option("--record-colour", request.record_colour,
                   "what the colours of --show-records tell: the radius, or the error predicted at the rim (default: "
                   "radius)")
      ->type_name("radius|error")
      ->check(CLI::IsMember({"radius", "error"}).description(""));
  verb->add_option("--slice", request.slice,
                   "where --show-records cuts the media: a point and a normal of a plane (default: facing the camera, "
                   "halfway through the records in media)")
      ->type_name("X,Y,Z;NX,NY,NZ");
  verb->add_option("--show-error", request.error_picture, "write a PNG of the relative error predicted in each pixel")
      ->type_name("FILE");
  verb->add_option("--show-density", request.density_picture, "write a PNG of the records per square metre")
      ->type_name("FILE");
  verb->add_option("--save-cache", request.save_cache, "write the records")->type_name("FILE");
  verb->add_option("--refine", request.refine,
                   "where the measured error exceeds the asked one, add records and rays, so many times at most")
      ->type_name("N")
      ->check(CLI::Range(0, 16).description(""));
  verb->add_flag_callback(
      "--no-check", [&request] { request.check = false; }, "do not measure the error");
}

void add_explain(CLI::App& program, app::ExplainRequest& request) {
  CLI::App* verb = program.add_subcommand("explain", "Tell which records made a pixel, and why these");
  add_scene(verb, request);
  verb->add_option("--pixel", request.pixel, "column and row of the pixel; 0,0 is at the top left")
      ->type_name("X,Y")
      ->required();
  verb->add_flag("--json", request.json, "print JSON");
  verb->add_option("-o,--output", request.picture, "write a PNG of the surroundings and these records' footprints")
      ->type_name("FILE");
}

void add_compare(CLI::App& program, app::CompareRequest& request) {
  CLI::App* verb = program.add_subcommand("compare", "Measure how a picture differs from a reference");
  verb->add_option("image", request.image, "EXR picture")->type_name("FILE")->required();
  verb->add_option("reference", request.reference, "EXR reference")->type_name("FILE")->required();
  verb->add_option("--second", request.second, "an independent second reference: the noise of both cancels")
      ->type_name("FILE");
  verb->add_option("--other", request.other,
                   "a picture like the first by another seed: only what both have in common counts as an error")
      ->type_name("FILE");
  verb->add_option("--layer", request.layer, "layer of both, such as irradiance or depth (default: the colours)")
      ->type_name("NAME");
  verb->add_option("--block", request.block, "average over blocks of N x N pixels first")
      ->type_name("N")
      ->check(CLI::Range(1, 4096).description(""));
  verb->add_option(
          "--error-picture", request.error_picture,
          "write a PNG of the differences in luminance: white none, blue too dark, red too bright; full colour "
          "from 20% of the reference's mean luminance")
      ->type_name("FILE");
  verb->add_option("--fail-above", request.fail_above, "exit with 1 where the relative RMSE is above this")
      ->type_name("E");
  verb->add_flag("--json", request.json, "print JSON");
}

int run(int argc, char** argv) {
  CLI::App program("Isophote: global illumination by caching light and its derivatives", "isophote");
  program.set_version_flag("--version", ISOPHOTE_VERSION);
  app::RenderRequest render_request;
  app::ExplainRequest explain_request;
  app::CompareRequest compare_request;
  add_render(program, render_request);
  add_explain(program, explain_request);
  add_compare(program, compare_request);
  program.add_subcommand("methods", "List the methods, estimators and metrics");
  const std::string first = argc > 1 ? argv[1] : "";
  std::string verbs;
  bool is_verb = false;
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; })) {
    verbs += (verbs.empty() ? "" : ", ") + verb->get_name();
    is_verb = is_verb || verb->get_name() == first;
  }
  if (argc > 1 && !is_verb && !first.starts_with('-'))
    throw UsageError("unknown command '" + first + "'; there are: " + verbs);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);
    throw UsageError(std::string(error.what()) + " (see isophote " + (is_verb ? first + " " : "") + "--help)");
  }
  if (program.got_subcommand("render")) return app::render(render_request);
  if (program.got_subcommand("explain")) return app::explain(explain_request);
  if (program.got_subcommand("compare")) return app::compare(compare_request);
  if (program.got_subcommand("methods")) return app::methods();
  throw UsageError("wants one of " + verbs + " (see isophote --help)");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const UsageError& error) {
    std::fprintf(stderr, "isophote: %s\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "isophote: out of memory\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "isophote: %s\n", error.what());
  }
  return 1;
}

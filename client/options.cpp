#include "client/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>

#include "client/report/picture_writer.h"
#include "common/renderers/make_renderer.h"
#include "common/scene/procedural.h"

namespace swath {
namespace {

constexpr std::size_t kMaxLocalServers = 64;

// Reads "ff8000".
Status parse_colour(const std::string& text, Rgb& colour) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (text.size() != 6 || error != std::errc{} || end != text.data() + text.size())
        return fail("--background: '{}': expected six hexadecimal digits, RRGGBB", text);
    colour = {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
              static_cast<std::uint8_t>(value)};
    return {};
}

// Reads "1,0.5,-2".
Status parse_light(const std::string& text, std::optional<glm::vec3>& light) {
    glm::vec3 to(0);
    const char* at = text.data();
    const char* const end = at + text.size();
    bool ok = true;
    for (int i = 0; i < 3 && ok; ++i) {
        if (i > 0) ok = at != end && *at++ == ',';
        const auto [stop, error] = std::from_chars(at, end, to[i]);
        ok = ok && error == std::errc{} && std::isfinite(to[i]);
        at = stop;
    }
    if (!ok || at != end || to == glm::vec3(0))
        return fail("--light: '{}': expected X,Y,Z, three finite numbers of which one is not 0", text);
    light = to;
    return {};
}

struct FlagOption {
    const char* name;
    bool RenderFlags::*flag;
    const char* help;
};
constexpr std::array kFlagOptions{
    FlagOption{"--shadows", &RenderFlags::shadows, "ray casters: hard shadows, cast by the whole model"},
    FlagOption{"--dynamic", &RenderFlags::dynamic,
               "ray casters: build the tree anew for every frame, over what a server is given to draw"}};

std::string builtin_list() {
    std::string list;
    for (const BuiltinModel& model : builtin_models())
        list += fmt::format("  builtin:{:10} {}\n", model.name, model.what);
    return list;
}

}  // namespace

tl::expected<ClientOptions, int> parse_client_options(int argc, char** argv) {
    ClientOptions options;
    std::string size = "1280x960";
    std::string background = "101218";
    std::string light;
    std::string algorithm = "hybrid";
    std::string renderer;
    std::string cull = "wide";
    std::string objects_by = "uniform";
    std::string format = "png";
    std::vector<std::string> servers;
    std::string display;
    int depth = 0;
    std::size_t frames = 0;

    CLI::App app{
        "swath-client: renders a large polygon model on a cluster without GPUs. Every frame it divides "
        "screen and model\n"
        "among the servers, which draw, swap pixels and send their tiles to the display.\n"};
    app.add_option("MODEL", options.model,
                   "a PLY, OBJ, STL, glTF, ... file, or builtin:NAME[:TRIANGLES] (see below)")
        ->required();
    auto* local =
        app.add_option("--local", options.local, "start a display and this many servers on this machine [4]")
            ->transform(whole_number(1, kMaxLocalServers));
    auto* remote =
        app.add_option("--servers", servers,
                       "HOST:PORT,... of running servers, dns:NAME:PORT or file:LIST; later ones join")
            ->delimiter(',')
            ->allow_extra_args(false);  // MODEL may follow
    auto* remote_display = app.add_option("--display", display, "HOST:PORT of a running swath-display");
    auto* single =
        app.add_flag("--single", options.single, "render here, in one process: the reference picture");
    remote->needs(remote_display)->excludes(local)->excludes(single);
    remote_display->needs(remote);
    single->excludes(local);
    std::string view;
    std::string max_view =
        fmt::format("{}x{}", options.view_limits.max_width, options.view_limits.max_height);
    auto* viewer =
        app.add_option("--view", view,
                       "live: a page at [HOST:]PORT [8080] shows and steers it; with --display at its --view")
            ->expected(0, 1)
            ->excludes(single);
    app.add_option("--view-max-size", max_view, "largest picture that viewers may ask for")
        ->capture_default_str()
        ->needs(viewer);
    app.add_option("--algorithm", algorithm,
                   "how to divide a frame: " + name_list<Algorithm>() + "; hybrid, unless to compare")
        ->capture_default_str();
    auto* draw_with =
        app.add_option("--renderer", renderer,
                       "raster (ours), osmesa, egl (surfaceless) or raycast; with commas between, for "
                       "the\nservers in turn [the first of the last three that works on this machine]");
    for (const FlagOption& one : kFlagOptions) app.add_flag(one.name, options.draw.flags.*one.flag, one.help);
    app.add_option(
           "--cull", cull,
           "how servers find what they draw: " + name_list<CullAlgorithm>() + "; wide, unless to compare")
        ->capture_default_str();
    app.add_option("--objects-by", objects_by,
                   "objects are cells of a uniform octree, or of a SAH octree: uniform, sah")
        ->capture_default_str();
    auto* objects = app.add_option("--objects", options.granularity.objects,
                                   "cut the model into about this many objects [1500]")
                        ->transform(whole_number(1, kMaxObjectsAsked));
    auto* octree = app.add_option("--octree-depth", depth, "... or by an octree of this depth")
                       ->transform(whole_number(0, kMaxOctreeDepth));
    octree->excludes(objects);
    app.add_option("--size", size, "of the picture in pixels")->capture_default_str();
    app.add_option("--background", background, "colour behind the model, RRGGBB")->capture_default_str();
    auto* light_at =
        app.add_option("--light", light, "X,Y,Z in the model's space, towards the light [the eye]");
    app.add_option("--pose", options.pose, "0 to 1: where a model that moves is held [to and fro; live 0]")
        ->transform(number_within(0, 1));
    auto* frame_count = app.add_option("--frames", frames, "how many [50, or all of a camera file]")
                            ->transform(whole_number(1, 1'000'000))
                            ->excludes(viewer);
    app.add_option(
           "--path", options.path,
           "orbit, random (as in the paper), or a FILE: a line a frame of eye, target, up, fov_degrees")
        ->capture_default_str();
    app.add_option("--seed", options.seed, "of the random path")
        ->capture_default_str()
        ->transform(whole_number());
    app.add_option("--zoom", options.zoom,
                   "1: the model's box fits in every frame (orbit) or is as high as the picture (random)")
        ->capture_default_str()
        ->transform(number_within(0.01, 100));
    app.add_option("--in-flight", options.in_flight, "frames begun and not complete at a time")
        ->capture_default_str()
        ->transform(whole_number(1, 8));
    add_threads_option(app, options.threads);
    add_trees_option(app, options.cuda)->excludes(remote);
    app.add_option("--out", options.out,
                   "folder for frame_0000.png and so on, or x.png, x.jpg for the only one [none are kept]")
        ->excludes(viewer);
    auto* picture_format = app.add_option("--format", format, "of the pictures: png (exact) or jpeg")
                               ->capture_default_str()
                               ->check(CLI::IsMember({"png", "jpeg"}))
                               ->excludes(viewer);
    app.add_option("--timeline", options.timeline,
                   "what every machine did when: FILE.csv, a table, or FILE.json for ui.perfetto.dev");
    app.add_option("--connect-s", options.connect_patience_s, "how long to try to reach servers and display")
        ->capture_default_str()
        ->transform(number_within(0.1, 3600));
    add_program_options(app, options.program, options.timing);
    app.footer("\nBuilt-in models, about a million triangles each unless :TRIANGLES says otherwise:\n" +
               builtin_list() + "\nExit codes: 0 done, 1 failed, 2 wrong usage.");
    if (const auto code = parse_options(app, argc, argv, [] { return protocol_here() + renderers_here(); }))
        return tl::unexpected(*code);

    const auto refuse = [](const Error& error) { return tl::unexpected(usage_error(error)); };
    const auto parsed_size = parse_size("--size", size);
    if (!parsed_size) return refuse(parsed_size.error());
    options.width = parsed_size->width;
    options.height = parsed_size->height;
    if (const auto s = parse_colour(background, options.background); !s) return refuse(s.error());
    if (light_at->count() > 0)
        if (const auto s = parse_light(light, options.light); !s) return refuse(s.error());
    const auto parsed = parse<Algorithm>(algorithm);
    if (!parsed) return refuse(parsed.error());
    options.algorithm = *parsed;
    const auto parsed_cull = parse<CullAlgorithm>(cull);
    if (!parsed_cull) return refuse({"--cull: " + parsed_cull.error().message});
    options.draw.cull = *parsed_cull;
    if (draw_with->count() > 0) {
        const auto renderers = parse_renderers(renderer);
        if (!renderers) return refuse({"--renderer: " + renderers.error().message});
        if (options.single && renderers->size() > 1)
            return refuse({fmt::format("--renderer: '{}': --single draws with one", renderer)});
        options.draw.renderers = *renderers;
    }
    if (!has_raycast(options.draw.renderers))
        for (const FlagOption& one : kFlagOptions)
            if (options.draw.flags.*one.flag)
                return refuse({fmt::format("{}: needs a ray caster, and --renderer is '{}'", one.name,
                                           draw_with->count() > 0 ? renderer : "osmesa, where it works")});
    const auto by = parse<ObjectsBy>(objects_by);
    if (!by) return refuse({"--objects-by: " + by.error().message});
    options.granularity.by = *by;
    if (octree->count() > 0 && *by == ObjectsBy::kSah)
        return refuse({"--octree-depth: a SAH octree has no one depth; with --objects-by sah say --objects"});
    if (octree->count() > 0) options.granularity.depth = depth;
    if (frame_count->count() > 0) options.frames = frames;
    options.format = options.out.empty() ? PictureFormat::kNone : *parse<PictureFormat>(format);
    if (const auto of_file = format_of_file(options.out)) {
        if (picture_format->count() > 0 && options.format != *of_file)
            return refuse({fmt::format("--out: '{}': --format says {}", options.out, format)});
        options.format = *of_file;
    }
    if (!options.timeline.empty() && !options.timeline.ends_with(".csv") &&
        !options.timeline.ends_with(".json"))
        return refuse(
            {fmt::format("--timeline: '{}': the name must end in .csv or .json", options.timeline)});
    if (!servers.empty()) {
        const auto source = parse_server_source(servers);
        if (!source) return refuse({"--servers: " + source.error().message});
        options.servers = *source;
    }
    if (!display.empty()) {
        const auto address = parse_address(display);
        if (!address) return refuse({"--display: " + address.error().message});
        options.display = *address;
    }
    if (viewer->count() > 0) {
        if (options.display && !view.empty())
            return refuse({"--view: this display runs already; give the port to its own --view"});
        options.view = options.display ? "" : view.empty() ? "8080" : view;
        if (!view.empty())
            if (const auto address = parse_local_address(view); !address)
                return refuse({"--view: " + address.error().message});
        const auto largest = parse_size("--view-max-size", max_view);
        if (!largest) return refuse(largest.error());
        options.view_limits.max_width = largest->width;
        options.view_limits.max_height = largest->height;
    }
    return options;
}

std::string to_arguments(const RenderFlags& flags) {
    std::string text;
    for (const FlagOption& one : kFlagOptions)
        if (flags.*one.flag) text += fmt::format(" {}", one.name);
    return text;
}

}  // namespace swath

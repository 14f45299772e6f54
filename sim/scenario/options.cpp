#include "sim/scenario/options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <thread>

#include "common/scene/model.h"

namespace swath::sim {
namespace {

Result<std::size_t> parse_servers(const std::string& text) {
    std::size_t servers = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), servers);
    if (error != std::errc{} || end != text.data() + text.size() || servers < 1 || servers > kMaxServers)
        return fail("--servers: '{}': expected a number from 1 to {}", text, kMaxServers);
    return servers;
}

// Appends a value that is not there yet.
template <class T>
void add_once(std::vector<T>& values, T value) {
    if (std::ranges::find(values, value) == values.end()) values.push_back(std::move(value));
}

}  // namespace

Result<ModelName> parse_model_name(const std::string& text) {
    ModelName model{{}, text};
    if (const auto equals = text.find('='); equals != std::string::npos) {
        model = {text.substr(0, equals), text.substr(equals + 1)};
        if (model.name.empty() || model.file.empty())
            return fail("'{}': expected NAME=FILE, or a FILE alone", text);
    } else if (is_builtin(text)) {
        const std::string name = text.substr(std::string_view("builtin:").size());
        model.name = name.substr(0, name.find(':'));
    } else {
        model.name = std::filesystem::path(text).stem().string();
    }
    if (model.name.empty()) return fail("'{}': expected a model's file, or builtin:NAME", text);
    if (std::ranges::any_of(model.name, [](unsigned char c) { return c < ' '; }))
        return fail("'{}': a model's name has no control characters", text);
    return model;
}

std::size_t threads_or_all(std::size_t wanted) {
    return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

void ScenarioFlags::add_to(CLI::App& app, bool many) {
    const std::string list = many ? "; several with commas between" : "";
    const auto values = [&](CLI::Option* option) {
        option->delimiter(',')->allow_extra_args(false);
        if (!many) option->expected(1);
        return option;
    };
    if (many)
        app.add_option("--model", models_, "[NAME=]FILE or builtin:NAME, as swath-client takes; repeatable")
            ->allow_extra_args(false)
            ->required();
    else
        app.add_option("MODEL", models_, "[NAME=]FILE or builtin:NAME, as swath-client takes")
            ->required()
            ->expected(1);
    app.add_option("--algorithm", algorithms_,
                   "how to divide a frame, several with commas between: " + name_list<Algorithm>() +
                       "\n(of which hybrid is the product's, the others are there to compare it with)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    app.add_option("--servers", servers_, "how many, several with commas between")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    values(app.add_option(
               "--hardware", hardware_,
               "a profile's name or a FILE.toml; the default is the paper's cluster, gbe-2026 machines of\n"
               "today on gigabit Ethernet, swath-sim hardware lists all" +
                   list))
        ->capture_default_str();
    values(app.add_option("--size", sizes_, "of the picture in pixels" + list))->capture_default_str();
    auto* depths =
        values(app.add_option("--octree-depth", depths_, "that cuts the model into objects [4]" + list)
                   ->transform(whole_number(0, kMaxOctreeDepth)));
    values(app.add_option("--objects", objects_, "... or about how many objects to cut it into" + list)
               ->transform(whole_number(1, kMaxObjectsAsked)))
        ->excludes(depths);
    app.add_option(
           "--objects-by", objects_by_,
           "what objects are: cells of a uniform octree, or with sah of one by the surface area heuristic, "
           "about --objects of them [1500]")
        ->capture_default_str();
    app.add_option("--path", path_.path,
                   "of the camera: random (seeded, the paper's), orbit, or a FILE as of swath-client")
        ->capture_default_str();
    app.add_option("--frames", path_.frames, "of a path; full mode takes about ten to settle")
        ->capture_default_str()
        ->transform(whole_number(1, 100'000));
    app.add_option(
           "--zoom", path_.zoom,
           "1: the longest side of the model's box is as high as the picture (random), or all of the\n"
           "box fits in every frame (orbit)")
        ->capture_default_str()
        ->transform(number_within(0.01, 100));
    app.add_option("--seed", path_.seed, "of the random path")
        ->capture_default_str()
        ->transform(whole_number());
    app.add_option("--seeds", path_.seeds, "how many random paths: SEED and those after it")
        ->capture_default_str()
        ->transform(whole_number(1, 10'000));
    app.add_option("--in-flight", frames_in_flight_, "frames begun and not complete at a time, in full mode")
        ->capture_default_str()
        ->transform(whole_number(1, 8));
    app.add_option("--threads", threads_, "to simulate with [one a core]")->transform(whole_number(1, 1024));
}

Result<ScenarioOptions> ScenarioFlags::read() const {
    ScenarioOptions options;
    for (const std::string& text : models_) {
        SWATH_TRY(auto model, parse_model_name(text));
        const auto taken = std::ranges::find(options.models, model.name, &ModelName::name);
        if (taken != options.models.end())
            return fail("two models are called '{}': name them, as in a={} b={}", model.name, taken->file,
                        model.file);
        options.models.push_back(std::move(model));
    }
    for (const std::string& text : algorithms_) {
        const auto algorithm = parse<Algorithm>(text);
        if (!algorithm) return fail_in("--algorithm", algorithm.error());
        add_once(options.algorithms, *algorithm);
    }
    for (const std::string& text : servers_) {
        SWATH_TRY(const auto servers, parse_servers(text));
        add_once(options.servers, servers);
    }
    for (const std::string& name : hardware_) add_once(options.hardware, name);
    for (const std::string& text : sizes_) {
        SWATH_TRY(const auto size, parse_size("--size", text));
        add_once(options.sizes, size);
    }
    const auto by = parse<ObjectsBy>(objects_by_);
    if (!by) return fail_in("--objects-by", by.error());
    const bool sah = *by == ObjectsBy::kSah;
    if (sah && !depths_.empty())
        return fail("--octree-depth: a SAH octree has no one depth; with --objects-by sah say --objects");
    for (const int depth : depths_) options.granularities.push_back({depth, 0});
    for (const std::size_t objects : objects_)
        options.granularities.push_back({.objects = objects, .by = *by});
    if (options.granularities.empty())
        options.granularities.push_back(sah ? Granularity{.by = *by} : Granularity{4, 0});
    options.path = path_;
    options.frames_in_flight = frames_in_flight_;
    options.threads = threads_or_all(threads_);
    return options;
}

}  // namespace swath::sim

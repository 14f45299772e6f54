#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "sim/studies/study.h"

namespace swath::sim {
namespace {

// Reads "dragon=1.06".
Result<std::pair<std::string, double>> parse_zoom(const std::string& text) {
    const auto equals = text.find('=');
    if (equals != std::string::npos && equals > 0) {
        double zoom = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + equals + 1, end, zoom);
        if (error == std::errc{} && stop == end && zoom >= 0.01 && zoom <= 100)
            return std::pair{text.substr(0, equals), zoom};
    }
    return fail("--zoom: '{}': expected MODEL=ZOOM, the zoom from 0.01 to 100", text);
}

}  // namespace

void StudyFlags::add_to(CLI::App& app) {
    app.add_option("NAME", names_, fmt::format("which: {}, or all", fmt::join(study_names(), ", ")))
        ->required();
    app.add_option("--model", models_,
                   "NAME=FILE, repeatable: hand, dragon and buddha are shown beside the paper's figures and "
                   "looked for in models/NAME.ply if they are not named; with other names only, those alone")
        ->allow_extra_args(false);
    app.add_option("--zoom", zooms_,
                   "MODEL=ZOOM, repeatable [hand=1.25, dragon=1.06, buddha=1.33: what the paper's screen "
                   "coverage suggests; others 1]")
        ->allow_extra_args(false);
    app.add_option("--hardware", options_.hardware,
                   "a profile's name (see swath-sim hardware) or a FILE.toml")
        ->capture_default_str();
    app.add_option("--frames", options_.frames, "of a camera path")
        ->capture_default_str()
        ->transform(whole_number(1, 100'000));
    app.add_option("--seed", options_.seed, "of the first camera path")
        ->capture_default_str()
        ->transform(whole_number());
    app.add_option("--seeds", options_.seeds, "how many camera paths: SEED and those after it")
        ->capture_default_str()
        ->transform(whole_number(1, 10'000));
    app.add_option("--threads", threads_, "to simulate with [one a core]")->transform(whole_number(1, 1024));
    app.add_option("--out", options_.out, "folder for tables, plots, pictures and index.html")->required();
    app.add_flag("--quiet", options_.quiet, "show no progress");
}

Result<StudyOptions> StudyFlags::read() const {
    StudyOptions options = options_;
    const std::vector<std::string> known = study_names();
    for (const std::string& name : names_) {
        if (name == "all")
            options.names = known;
        else if (std::ranges::find(known, name) != known.end())
            options.names.push_back(name);
        else
            return fail("study '{}' is not known; there are: {}, all", name, fmt::join(known, ", "));
    }
    for (const std::string& text : models_) {
        auto model = parse_model_name(text);
        if (!model) return fail_in("--model", model.error());
        if (std::ranges::find(options.models, model->name, &ModelName::name) != options.models.end())
            return fail("--model: two models are called '{}'", model->name);
        options.models.push_back(std::move(*model));
    }
    for (const std::string& text : zooms_) {
        SWATH_TRY(const auto zoom, parse_zoom(text));
        if (!options.zooms.insert(zoom).second) return fail("--zoom: '{}' has two of them", zoom.first);
    }
    options.threads = threads_or_all(threads_);
    return options;
}

}  // namespace swath::sim

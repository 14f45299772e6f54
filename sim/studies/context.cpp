#include "sim/studies/context.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/file.h"
#include "common/program/progress.h"
#include "sim/hardware/hardware.h"

namespace swath::sim {
namespace {

// The paper's models. `zoom` gives the model's box the mean area on the screen that Table 1's display column
// has.
struct PaperModel {
    std::string_view name;
    double zoom;
    std::string_view stand_in;  // for when there is no mesh
};
constexpr std::array kPaperModels{PaperModel{"hand", 1.25, "builtin:hand"}, PaperModel{"dragon", 1.06, ""},
                                  PaperModel{"buddha", 1.33, ""}};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

const PaperModel* paper_model(const std::string& name) {
    const auto found = std::ranges::find(kPaperModels, lower(name), &PaperModel::name);
    return found == kPaperModels.end() ? nullptr : &*found;
}

}  // namespace

std::string table_name(Algorithm algorithm) {
    return algorithm == Algorithm::kMahd ? "sort-first" : std::string(name_of(algorithm));
}

std::string file_name_of(std::string_view text) {
    std::string name;
    for (const char c : text) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              c == '-' || c == '_' || c == '.';
        name += is_plain ? std::string(1, c) : fmt::format("~{:02x}", static_cast<unsigned char>(c));
    }
    return name;
}

std::string quotient(double of, double by, int decimals) {
    return by > 0 ? fmt::format("{:.{}f}", of / by, decimals) : "–";
}

double Results::value(Algorithm algorithm, const std::string& model, std::size_t servers,
                      std::string_view column) const {
    for (std::size_t i = 0; i < experiments.size(); ++i) {
        const Experiment& e = experiments[i];
        if (e.algorithm != algorithm || e.model_name != model || e.servers != servers) continue;
        for (const Row& row : all_rows(e, outcomes[i]))
            if (row.column == column) return row.value;
    }
    throw CheckFailed(fmt::format("no {} of {}, {}, {} servers", column, name_of(algorithm), model, servers));
}

std::vector<Row> Results::rows() const {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < experiments.size(); ++i)
        std::ranges::move(all_rows(experiments[i], outcomes[i]), std::back_inserter(rows));
    return rows;
}

StudyContext::StudyContext(const StudyOptions& options)
    : options_(options), page_("Hybrid sort-first and sort-last rendering: the paper's studies, run again") {}

Result<StudyContext> StudyContext::open(const StudyOptions& options) {
    StudyContext context(options);
    auto hardware = find_hardware(options.hardware);
    if (!hardware) return fail_in("--hardware", hardware.error());
    context.hardware_store_.push_back(std::move(*hardware));
    context.hardware_ = &context.hardware_store_.front();
    // Before anything long: tries whether the results can be written.
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error) return fail("--out: {}: {}", options.out.string(), error.message());
    if (::access(options.out.c_str(), W_OK | X_OK) != 0)
        return fail("--out: {}: {}", options.out.string(), std::strerror(errno));

    const auto is_paper_model = [](const ModelName& model) { return paper_model(model.name) != nullptr; };
    if (options.models.empty() || std::ranges::any_of(options.models, is_paper_model))
        for (const PaperModel& model : kPaperModels)
            SWATH_TRY_VOID(context.add_paper_subject(std::string(model.name), std::string(model.stand_in)));
    for (const ModelName& name : options.models) {
        if (is_paper_model(name)) continue;
        SWATH_TRY_VOID(context.add_subject(name, false));
    }
    for (const auto& [name, zoom] : options.zooms)
        if (!context.has_subject(name)) return fail("--zoom: no model is called '{}'", name);
    return context;
}

bool StudyContext::has_subject(const std::string& name) const {
    return std::ranges::any_of(subjects_, [&](const StudySubject& s) { return s.model.name == name; });
}

Status StudyContext::add_paper_subject(const std::string& name, const std::string& stand_in) {
    const ModelName* ours = nullptr;
    for (const ModelName& given : options_.models) {
        if (lower(given.name) != name) continue;
        if (ours != nullptr)
            return fail("--model: '{}' and '{}' are both the paper's {}", ours->name, given.name, name);
        ours = &given;
    }
    if (ours != nullptr) return add_subject(*ours, false);
    const std::string file = fmt::format("models/{}.ply", name);
    if (std::filesystem::exists(file)) return add_subject({name, file}, false);
    std::string title = name;
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    const std::string absent = fmt::format(
        "The paper's {} is not here ({} does not exist; --model {}=FILE names another place): ", title, file,
        name);
    if (stand_in.empty()) {
        absences_.push_back(absent + "it is left out.");
        return {};
    }
    absences_.push_back(absent + stand_in + ", a procedural model, stands in for it.");
    return add_subject({name + "-stand-in", stand_in}, true);
}

Status StudyContext::add_subject(const ModelName& name, bool stand_in) {
    if (has_subject(name.name)) return fail("--model: two models are called '{}'", name.name);
    auto model = load_study_model(name.name, name.file, {kPaperDepth, 0});
    if (!model) return fail_in("--model " + name.name, model.error());
    StudySubject subject{std::move(*model), name.file, {}, stand_in, 1, {}};
    const std::string of = stand_in ? name.name.substr(0, name.name.find('-')) : name.name;
    if (const PaperModel* known = paper_model(of)) {
        subject.paper_name = known->name;
        subject.zoom = known->zoom;
    }
    if (const auto zoom = options_.zooms.find(name.name); zoom != options_.zooms.end())
        subject.zoom = zoom->second;
    SWATH_TRY(subject.paths,
              make_paths({"random", options_.frames, subject.zoom, options_.seed, options_.seeds},
                         subject.model.scene.swept_bounds(), kPaperWidth, kPaperHeight));
    subjects_.push_back(std::move(subject));
    return {};
}

const StudySubject& StudyContext::figures_subject() const {
    for (const char* name : {"buddha", "dragon"})
        for (const StudySubject& subject : subjects_)
            if (subject.paper_name == name) return subject;
    return subjects_.front();
}

std::vector<Experiment> StudyContext::experiments(const StudySubject& subject, const StudyModel& model,
                                                  std::span<const Algorithm> algorithms, int width,
                                                  int height) const {
    std::vector<Experiment> experiments;
    for (const Algorithm algorithm : algorithms) {
        for (const std::size_t servers : kPaperServers) {
            Experiment e;
            e.model = &model;
            e.paths = &subject.paths;
            e.hardware = hardware_;
            e.algorithm = algorithm;
            e.servers = servers;
            e.width = width;
            e.height = height;
            e.algorithm_name = table_name(algorithm);
            e.model_name = model.name;
            experiments.push_back(e);
        }
    }
    return experiments;
}

Results StudyContext::run(std::vector<Experiment> experiments, const std::string& what) const {
    const SteadyClock clock;
    Progress progress(experiments.size(), "experiments of " + what, options_.quiet, clock);
    auto outcomes =
        run_experiments(experiments, options_.threads, [&](std::size_t, const Outcome&) { progress.step(); });
    return {std::move(experiments), std::move(outcomes)};
}

const Results& StudyContext::table1() {
    if (table1_.experiments.empty()) {
        std::vector<Experiment> all;
        for (const StudySubject& subject : subjects_)
            std::ranges::move(experiments(subject, subject.model, kAll<Algorithm>, kPaperWidth, kPaperHeight),
                              std::back_inserter(all));
        table1_ = run(std::move(all), "Table 1");
    }
    return table1_;
}

Status StudyContext::write(const std::string& file, std::string_view text) const {
    return write_file(options_.out / file, text);
}

}  // namespace swath::sim

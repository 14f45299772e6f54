#include "sim/sweep/sweep.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>

#include "common/base/file.h"
#include "common/program/progress.h"
#include "sim/sweep/journal_file.h"

namespace swath::sim {
namespace {

namespace fs = std::filesystem;

Status prepare_folder(const fs::path& folder, const fs::path& table) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return fail("--out: {}: {}", folder.string(), error.message());
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return fail("--out: {}: {}", folder.string(), std::strerror(errno));
    if (fs::exists(table, error) && !fs::is_regular_file(table, error))
        return fail("--out: {}: not a regular file", table.string());
    return {};
}

// Runs the experiments that are not in the journal.
Status complete(const std::vector<Experiment>& experiments, std::size_t threads, JournalFile& journal,
                Progress& progress) {
    std::vector<Experiment> missing;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
        if (!journal.rows()[i].empty()) continue;
        missing.push_back(experiments[i]);
        places.push_back(i);
    }
    struct Stop {};
    Status status;
    try {
        run_experiments(missing, threads, [&](std::size_t i, const Outcome& outcome) {
            if (!status) return;  // other threads were still at work when it failed
            status = journal.append(places[i], lines_of(all_rows(missing[i], outcome)));
            if (!status) throw Stop{};
            progress.step();
        });
    } catch (const Stop&) {
    }
    return status;
}

}  // namespace

Result<SweepResult> run_sweep(const Scenario& scenario, const SweepOptions& options, const Clock& clock) {
    const std::vector<Experiment>& experiments = scenario.experiments();
    SweepResult result{options.out / "sweep.csv", experiments.size(), 0};
    SWATH_TRY_VOID(prepare_folder(options.out, result.table));

    std::vector<Row> labels;
    for (const Experiment& experiment : experiments) labels.push_back(experiment.label());
    const fs::path path = options.out / "sweep.journal";
    SWATH_TRY(const auto opened, JournalFile::open(path, journal_head(scenario.settings()), labels));
    JournalFile& journal = *opened;
    if (journal.was_cut_off())
        std::cerr << "notice: " << path.string() << ": the last entry was cut off and is run again\n";

    const auto missing = static_cast<std::size_t>(std::ranges::count(journal.rows(), ""));
    result.from_before = experiments.size() - missing;
    if (missing > 0) {
        Progress progress(missing, "experiments", options.quiet, clock);
        SWATH_TRY_VOID(complete(experiments, options.scenario.threads, journal, progress));
    }
    std::string table = to_csv({});
    for (const std::string& rows : journal.rows()) table += rows;
    SWATH_TRY_VOID(write_file(result.table, table));
    return result;
}

Status sweep(const SweepOptions& options, const Clock& clock) {
    SWATH_TRY(const auto scenario, Scenario::load(options.scenario));
    SWATH_TRY(const auto result, run_sweep(scenario, options, clock));
    std::cout << fmt::format("table: {} ({} experiments, {} of them from before)\n", result.table.string(),
                             result.experiments, result.from_before);
    return {};
}

}  // namespace swath::sim

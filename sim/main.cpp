#include <CLI/CLI.hpp>
#include <iostream>

#include "common/base/allocator.h"
#include "common/program/cli.h"
#include "sim/compare/compare.h"
#include "sim/hardware/hardware.h"
#include "sim/run/run.h"
#include "sim/studies/study.h"
#include "sim/sweep/sweep.h"

int main(int argc, char** argv) {
    using namespace swath;
    using namespace swath::sim;
    CLI::App app{
        "swath-sim: what a cluster would do, on hardware that is described rather than there. It runs the "
        "partitioners and\nthe decisions of the real programs with modelled durations.\n"};
    app.require_subcommand(0, 1);  // without one, a wrong word is what there is to say something about

    RunOptions run_options;
    ScenarioFlags run_flags;
    auto* run_command = app.add_subcommand("run", "simulate one scenario, paper mode beside full mode");
    run_flags.add_to(*run_command, false);
    run_command->add_option("--csv", run_options.csv, "write the table to this file");
    run_command->add_option(
        "--timeline", run_options.timeline,
        "what every machine did when: FILE.csv, a table, or FILE.json for ui.perfetto.dev or,\n"
        "without a network, a Chromium's chrome://tracing");

    SweepOptions sweep_options;
    ScenarioFlags sweep_flags;
    auto* sweep_command = app.add_subcommand(
        "sweep",
        "simulate everything combined with everything into one table; goes on where it was interrupted");
    sweep_flags.add_to(*sweep_command, true);
    sweep_command->add_option("--out", sweep_options.out, "folder for sweep.csv and its journal")->required();
    sweep_command->add_flag("--quiet", sweep_options.quiet, "no progress");

    StudyFlags study_flags;
    auto* study_command = app.add_subcommand("study", "repeat the paper's studies, as a page to read");
    study_flags.add_to(*study_command);

    std::vector<std::string> inputs;
    std::string compare_out;
    auto* compare_command =
        app.add_subcommand("compare", "overlay speed-up curves: simulated, published, of the real cluster");
    compare_command
        ->add_option(
            "FILE", inputs,
            "[LABEL=]FILE: a table as this program writes them (or sim/published/table1.csv), or a "
            "timeline of\nswath-client --timeline FILE.csv; those of one label make a curve and need "
            "one of a single server\n(or of --single, which is nearer to what simulated speed-ups are over)")
        ->required();
    compare_command->add_option("--out", compare_out, "folder for compare.csv, .svg and .png")->required();

    std::string profile;
    auto* hardware_command = app.add_subcommand("hardware", "list hardware profiles, or explain one");
    hardware_command->add_option("PROFILE", profile, "a built-in's name or a FILE.toml");

    if (const auto code = parse_options(app, argc, argv)) return *code;
    if (app.get_subcommands().empty())
        return usage_error({"a subcommand is needed: run, sweep, study, compare or hardware"});
    tune_allocator();
    Status status;
    if (run_command->parsed()) {
        auto scenario = run_flags.read();
        if (!scenario) return usage_error(scenario.error());
        run_options.scenario = std::move(*scenario);
        if (const auto wrong = check(run_options); !wrong) return usage_error(wrong.error());
        status = run(run_options, SteadyClock());
    } else if (sweep_command->parsed()) {
        auto scenario = sweep_flags.read();
        if (!scenario) return usage_error(scenario.error());
        sweep_options.scenario = std::move(*scenario);
        status = sweep(sweep_options, SteadyClock());
    } else if (study_command->parsed()) {
        auto studies = study_flags.read();
        if (!studies) return usage_error(studies.error());
        status = run_studies(*studies);
    } else if (compare_command->parsed()) {
        const auto curves = read_curves(inputs);
        status = curves ? write_comparison(*curves, compare_out) : tl::unexpected(curves.error());
        if (status)
            std::cout << to_text(*curves) << "comparison: " << compare_out << "/compare.svg, .png and .csv\n";
    } else if (profile.empty()) {
        for (const std::string& name : builtin_hardware())
            std::cout << fmt::format("{:<10}  {}\n", name, find_hardware(name)->about);
    } else {
        const auto hardware = find_hardware(profile);
        if (hardware)
            std::cout << explain(*hardware);
        else
            status = tl::unexpected(hardware.error());
    }
    return status ? kExitDone : run_error(status.error());
}

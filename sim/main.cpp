#include <CLI/CLI.hpp>
#include <iostream>

#include "common/program/cli.h"
#include "sim/hardware/hardware.h"
#include "sim/run/run.h"
#include "sim/sweep/sweep.h"

int main(int argc, char** argv) {
    using namespace swath;
    using namespace swath::sim;
    CLI::App app{
        "swath-sim: what a cluster would do, on hardware that is described rather than there. It runs the "
        "partitioners and\nthe decisions of the real programs with modelled durations.\n"};
    app.require_subcommand(1);

    RunOptions run_options;
    ScenarioFlags run_flags;
    auto* run_command = app.add_subcommand("run", "simulate one scenario, paper mode beside full mode");
    run_flags.add_to(*run_command, false);
    run_command->add_option("--csv", run_options.csv, "write the table to this file");
    run_command->add_option("--timeline", run_options.timeline,
                            "what every machine did when: FILE.csv, or FILE.json for ui.perfetto.dev");

    SweepOptions sweep_options;
    ScenarioFlags sweep_flags;
    auto* sweep_command = app.add_subcommand(
        "sweep",
        "simulate everything combined with everything into one table; goes on where it was interrupted");
    sweep_flags.add_to(*sweep_command, true);
    sweep_command->add_option("--out", sweep_options.out, "folder for sweep.csv and its journal")->required();
    sweep_command->add_flag("--quiet", sweep_options.quiet, "no progress");

    std::string profile;
    auto* hardware_command = app.add_subcommand("hardware", "list hardware profiles, or explain one");
    hardware_command->add_option("PROFILE", profile, "a built-in's name or a FILE.toml");

    if (const auto code = parse_options(app, argc, argv)) return *code;
    Status status;
    if (run_command->parsed()) {
        auto scenario = run_flags.read();
        if (!scenario) return usage_error(scenario.error());
        run_options.scenario = std::move(*scenario);
        status = run(run_options);
    } else if (sweep_command->parsed()) {
        auto scenario = sweep_flags.read();
        if (!scenario) return usage_error(scenario.error());
        sweep_options.scenario = std::move(*scenario);
        status = sweep(sweep_options, SteadyClock());
    } else if (profile.empty()) {
        for (const std::string& name : builtin_hardware())
            std::cout << name << "  " << find_hardware(name)->about << '\n';
    } else {
        const auto hardware = find_hardware(profile);
        if (hardware)
            std::cout << explain(*hardware);
        else
            status = tl::unexpected(hardware.error());
    }
    return status ? kExitDone : run_error(status.error());
}

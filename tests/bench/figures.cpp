#include "tests/bench/figures.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/models.h"

namespace swath::bench {
namespace {

std::string first_line_of(const char* command) {
    std::string line = "unknown";
    if (FILE* pipe = ::popen(command, "r")) {
        std::array<char, 128> text{};
        if (std::fgets(text.data(), static_cast<int>(text.size()), pipe) != nullptr) line = text.data();
        ::pclose(pipe);
    }
    while (!line.empty() && line.back() == '\n') line.pop_back();
    return line;
}

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

}  // namespace

double median(std::vector<double> samples) {
    if (samples.empty()) return 0;
    std::sort(samples.begin(), samples.end());
    const std::size_t half = samples.size() / 2;
    return samples.size() % 2 == 1 ? samples[half] : 0.5 * (samples[half - 1] + samples[half]);
}

void Figures::add(const std::string& name, std::vector<double> samples, const std::string& unit,
                  const std::string& bar) {
    const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
    const double value = median(samples);
    figures_.push_back(
        {name, value, value != 0 ? (*high - *low) / std::abs(value) : 0, samples.size(), unit, bar});
}

std::string Figures::to_text(const std::string& benchmark) const {
    const double load = [] {
        double one = 0;
        return ::getloadavg(&one, 1) == 1 ? one : 0;
    }();
    std::string text =
        fmt::format("swath-bench {}: commit {}, {} ({} cores), load {:.1f}\n", benchmark,
                    first_line_of("git -C " SWATH_SOURCE_DIR " describe --always --dirty 2>/dev/null"),
                    processor(), sysconf(_SC_NPROCESSORS_ONLN), load);
    text += fmt::format("{:26} {:>10} {:8} {:>7} {:>3}  {}\n", "figure", "median", "unit", "noise", "n",
                        "held against");
    for (const Figure& f : figures_)
        text += fmt::format("{:26} {:>10.3f} {:8} {:>6.1f}% {:>3}  {}\n", f.name, f.value, f.unit,
                            100 * f.noise, f.samples, f.bar);
    for (const std::string& note : notes_) text += note + '\n';
    return text;
}

std::string Figures::to_json() const {
    nlohmann::json json;
    json["figures"] = nlohmann::json::object();
    for (const Figure& f : figures_) json["figures"][f.name] = f.value;
    return json.dump(2) + '\n';
}

Result<Effort> full_effort(bool needs_model) {
    if (const auto shared = test::shared_model("dragon.ply")) return Effort{shared->string(), 5, 54};
    const std::filesystem::path fetched = std::filesystem::path(SWATH_SOURCE_DIR) / "models/dragon.ply";
    if (!needs_model || std::filesystem::exists(fetched)) return Effort{fetched.string(), 5, 54};
    return fail("the benchmarks render the Stanford Dragon: get it with script/fetch-models");
}

Effort smoke_effort() { return {"builtin:knot:20000", 1, 2, true}; }

std::string client_program() {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "swath-client").string();
}

double Finished::frames_per_s() const {
    const auto end = output.find(" frames/s");
    if (end == std::string::npos) return 0;
    return std::atof(output.c_str() + output.rfind(' ', end - 1));
}

Finished run_program(const std::vector<std::string>& command) {
    std::array<int, 2> out{};
    if (::pipe(out.data()) != 0) return {};
    const auto begin = std::chrono::steady_clock::now();
    const pid_t pid = ::fork();
    if (pid == 0) {
        ::dup2(out[1], STDOUT_FILENO);
        ::close(out[0]);
        ::close(out[1]);
        std::vector<char*> arguments;
        for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
        arguments.push_back(nullptr);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(out[1]);
    Finished finished;
    std::array<char, 4096> block{};
    for (ssize_t got = 0; (got = ::read(out[0], block.data(), block.size())) > 0;)
        finished.output.append(block.data(), static_cast<std::size_t>(got));
    ::close(out[0]);
    int status = 0;
    rusage usage{};
    ::wait4(pid, &status, 0, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    finished.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    finished.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return finished;
}

}  // namespace swath::bench

#include "tests/e2e/schedulers/slurm_cluster.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "common/base/check.h"

namespace swath::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kBetweenQuestions(100);
constexpr std::chrono::seconds kDaemonEnds(10);

// script/bootstrap --schedulers unpacks Debian's packages here.
const fs::path& unpacked() {
    static const fs::path folder = SWATH_SLURM;
    return folder;
}
fs::path libraries() { return unpacked() / SWATH_SLURM_LIBRARIES; }

std::optional<fs::path> find(const std::string& program) {
    const char* path = std::getenv("PATH");
    // A user's PATH often lacks the folders of daemons.
    std::istringstream folders(fmt::format("{0}/usr/bin:{0}/usr/sbin:{1}:/usr/sbin:/sbin",
                                           unpacked().string(), path == nullptr ? "" : path));
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return fs::path(folder) / program;
    return {};
}

std::vector<std::string> with_slurm(std::vector<std::string> environment, const std::string& configuration) {
    environment.push_back("SLURM_CONF=" + configuration);
    if (fs::exists(unpacked())) {
        const char* path = std::getenv("PATH");
        environment.push_back(
            fmt::format("PATH={}/usr/bin:{}", unpacked().string(), path == nullptr ? "" : path));
        environment.push_back(fmt::format("LD_LIBRARY_PATH={0}:{0}/slurm-wlm", libraries().string()));
    }
    return environment;
}

std::vector<int> free_ports(std::size_t count) {
    std::vector<int> sockets;
    std::vector<int> ports;
    // Holds all ports until all are known, so that none comes twice.
    while (sockets.size() < count) {
        sockets.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        socklen_t size = sizeof address;
        auto* any = reinterpret_cast<sockaddr*>(&address);
        CHECK(::bind(sockets.back(), any, size) == 0);
        CHECK(::getsockname(sockets.back(), any, &size) == 0);
        ports.push_back(ntohs(address.sin_port));
    }
    for (const int socket : sockets) ::close(socket);
    return ports;
}

std::string configuration(const fs::path& folder, const std::vector<int>& ports) {
    std::string text = fmt::format(R"(ClusterName=swath
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.sock
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
KillWait=5
)",
                                   fmt::arg("port", ports.front()), fmt::arg("user", ::getuid()),
                                   fmt::arg("folder", folder.string()));
    for (std::size_t node = 1; node < ports.size(); ++node)
        text += fmt::format("NodeName=n{} NodeHostname=localhost NodeAddr=127.0.0.{} Port={} CPUs=4\n", node,
                            node, ports[node]);
    if (fs::exists(unpacked())) text += fmt::format("PluginDir={}/slurm-wlm\n", libraries().string());
    return text + "PartitionName=all Nodes=ALL Default=YES State=UP\n";
}

}  // namespace

bool eventually(const std::function<bool()>& condition, std::chrono::milliseconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(kBetweenQuestions);
    }
    return true;
}

std::string SlurmCluster::missing() {
    for (const char* program : {"munged", "slurmctld", "slurmd", "slurmstepd", "sbatch", "srun", "scancel",
                                "scontrol", "sinfo", "squeue"})
        if (!find(program)) return fmt::format("no {} here (script/bootstrap --schedulers gets it)", program);
    return {};
}

SlurmCluster::SlurmCluster(const fs::path& folder, int nodes) : configuration_(folder / "slurm.conf") {
    fs::create_directories(folder / "state");
    // munged wants its socket where everybody may go. The key is for us only.
    for (const fs::path& reached : {folder.parent_path(), folder})
        fs::permissions(reached, fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
    const std::string key = folder / "munge.key";
    std::ofstream(key) << std::string(128, 'k');
    fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write);
    std::ofstream(configuration_) << configuration(folder, free_ports(static_cast<std::size_t>(nodes) + 1));

    const auto start = [&](const std::string& program, const Arguments& arguments) {
        daemons_.push_back(std::make_unique<Process>(*find(program), arguments,
                                                     Process::Options{with_slurm({}, configuration_), {}}));
    };
    const auto in_folder = [&](const char* name) { return (folder / name).string(); };
    start("munged", {"--foreground", "--num-threads", "2", "--key-file", key, "--socket",
                     in_folder("munge.sock"), "--pid-file", in_folder("munged.pid"), "--log-file",
                     in_folder("munged.log"), "--seed-file", in_folder("munge.seed")});
    if (!eventually([&] { return fs::exists(folder / "munge.sock"); }))
        throw std::runtime_error("munged does not start:\n" + contents(folder / "munged.log"));
    start("slurmctld", {"-D", "-c"});
    for (int node = 1; node <= nodes; ++node)
        start("slurmd", {"-D", "-N", fmt::format("n{}", node), "-d", find("slurmstepd")->string()});
    const std::string idle = fmt::format("idle {}\n", nodes);
    if (!eventually([&] { return run("sinfo", {"--noheader", "--format=%T %D"}).out == idle; }))
        throw std::runtime_error("Slurm does not start:\n" + contents(folder / "slurmctld.log"));
}

SlurmCluster::~SlurmCluster() {
    // Ends jobs first, then the nodes, then the daemons that they talk to.
    run("scancel", {fmt::format("--user={}", ::getuid())});
    eventually([&] { return run("squeue", {"--noheader"}).out.empty(); }, kDaemonEnds);
    std::reverse(daemons_.begin(), daemons_.end());
    for (const auto& daemon : daemons_) {
        daemon->signal(SIGTERM);
        try {
            daemon->wait(kDaemonEnds);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
    // slurmd leaves its steps to init, whose part the test plays.
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
}

Finished SlurmCluster::run(const std::string& program, const Arguments& arguments,
                           std::vector<std::string> environment, const fs::path& folder) const {
    return Process(*find(program), arguments, {with_slurm(std::move(environment), configuration_), folder})
        .wait(kPatience);
}

std::string SlurmCluster::submit(const fs::path& folder, const Arguments& sbatch, const Arguments& swath,
                                 std::vector<std::string> environment) const {
    Finished finished = run("sbatch", Arguments{"--parsable"} + sbatch + Arguments{SWATH_SBATCH} + swath,
                            std::move(environment), folder);
    if (finished.exit_code != 0) throw std::runtime_error("sbatch: " + finished.err);
    return finished.out.substr(0, finished.out.find('\n'));
}

void SlurmCluster::cancel(const std::string& job) const { run("scancel", {job}); }

std::string SlurmCluster::end_of(const std::string& job) const {
    std::string state;
    const auto value = [](const std::string& text, const std::string& name) {
        const auto begin = text.find(" " + name + "=") + name.size() + 2;
        return text.substr(begin, text.find(' ', begin) - begin);
    };
    const bool ended = eventually([&] {
        const std::string text = run("scontrol", {"show", "job", "--oneliner", job}).out;
        state = value(text, "JobState") + " " + value(text, "ExitCode");
        return !state.starts_with("PENDING") && !state.starts_with("RUNNING") &&
               !state.starts_with("COMPLETING");
    });
    if (!ended) throw std::runtime_error("job " + job + " does not end: " + state);
    return state;
}

}  // namespace swath::test

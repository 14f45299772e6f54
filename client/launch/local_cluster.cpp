#include "client/launch/local_cluster.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>
#include <utility>

namespace swath {
namespace {

// A program leaves as soon as its lifeline closes. One that is frozen cannot, and is killed after this.
constexpr auto kLeavePatience = std::chrono::milliseconds(300);

}  // namespace

struct LocalCluster::Child {
    // Both ends close on exec: a child that inherited another child's lifeline would keep that child alive.
    struct Pipe {
        std::array<int, 2> ends{-1, -1};  // to read from, to write to
        Pipe() {
            if (::pipe2(ends.data(), O_CLOEXEC) != 0)
                throw std::system_error(errno, std::generic_category(), "pipe");
        }
        ~Pipe() {
            close(0);
            close(1);
        }
        Pipe(const Pipe&) = delete;
        Pipe& operator=(const Pipe&) = delete;
        void close(std::size_t end) {
            if (ends[end] >= 0) ::close(std::exchange(ends[end], -1));
        }

        // Without its end; what there is when the program ends before that.
        std::string read_line() const {
            std::string line;
            char c = 0;
            for (;;) {
                const ssize_t got = ::read(ends[0], &c, 1);
                if (got < 0 && errno == EINTR) continue;
                if (got <= 0 || c == '\n') return line;
                line += c;
            }
        }
    };

    std::string name;
    Pipe lifeline;
    Pipe output;
    pid_t pid = -1;

    // Whether it has ended; then it is no process any more.
    bool ended(int flags) { return ::waitpid(pid, nullptr, flags) == pid; }
};

LocalCluster::LocalCluster() = default;
LocalCluster::~LocalCluster() { end(); }

Result<std::unique_ptr<LocalCluster::Child>> LocalCluster::spawn(const std::filesystem::path& program,
                                                                 const std::vector<std::string>& arguments) {
    auto child = std::make_unique<Child>();
    child->name = program.filename().string();
    std::vector<std::string> all{"--listen", "127.0.0.1:0", "--lifeline"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (std::string& argument : all) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, child->lifeline.ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, child->output.ends[1], STDOUT_FILENO);
    const int error = ::posix_spawn(&child->pid, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
        return fail("cannot start {}: {}", program.string(), std::generic_category().message(error));
    child->lifeline.close(0);
    child->output.close(1);
    return child;
}

Result<std::unique_ptr<LocalCluster>> LocalCluster::start(const Options& options) {
    std::unique_ptr<LocalCluster> cluster(new LocalCluster);
    // Starts all before it waits for any.
    for (std::size_t i = 0; i <= options.servers; ++i) {
        std::vector<std::string> arguments = options.arguments;
        const auto& own = i > 0 ? options.server_arguments : options.display_arguments;
        arguments.insert(arguments.end(), own.begin(), own.end());
        SWATH_TRY(auto child,
                  spawn(options.programs / (i == 0 ? "swath-display" : "swath-server"), arguments));
        cluster->children_.push_back(std::move(child));
    }
    for (std::size_t i = 0; i < cluster->children_.size(); ++i) {
        Child& child = *cluster->children_[i];
        const std::string line = child.output.read_line();
        static constexpr std::string_view kAnnouncement = "listening ";
        if (!line.starts_with(kAnnouncement)) return fail("{} did not start", child.name);
        SWATH_TRY(const auto address, parse_address(std::string_view(line).substr(kAnnouncement.size())));
        if (i == 0)
            cluster->display_ = address;
        else
            cluster->servers_.push_back(address);
    }
    return cluster;
}

void LocalCluster::end() {
    for (const auto& child : children_) child->lifeline.close(1);
    const auto deadline = std::chrono::steady_clock::now() + kLeavePatience;
    for (const auto& child : children_) {
        bool ended = child->ended(WNOHANG);
        for (; !ended && std::chrono::steady_clock::now() < deadline; ended = child->ended(WNOHANG))
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (ended) continue;
        ::kill(child->pid, SIGKILL);
        child->ended(0);
    }
    children_.clear();
}

}  // namespace swath

#include "tests/support/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace swath::test {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kPipeBytes = 1 << 20;
constexpr std::chrono::seconds kDying(5);  // a killed program is gone within this

[[noreturn]] void fail_with_errno(const std::string& what, int code) {
    throw std::runtime_error(what + ": " + std::strerror(code));
}

int milliseconds_until(SteadyClock::time_point deadline) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - SteadyClock::now()).count();
    return static_cast<int>(std::max<std::int64_t>(left, 0));
}

int open_process(pid_t pid) { return static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)); }

// A pipe; both ends close on exec.
std::array<int, 2> make_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_with_errno("pipe", errno);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    ::fcntl(ends[0], F_SETPIPE_SZ, kPipeBytes);
    return ends;
}

std::string read_all(const std::string& path) {
    // Iterators would throw when a process vanishes while its file is read.
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The state letter and the parent in /proc/PID/stat, whose second field may contain anything.
struct Stat {
    char state = 'X';
    pid_t parent = 0;
};
Stat stat_of(pid_t pid) {
    const std::string text = read_all("/proc/" + std::to_string(pid) + "/stat");
    const auto after_name = text.rfind(')');
    if (after_name == std::string::npos || after_name + 4 >= text.size()) return {};
    Stat stat;
    stat.state = text[after_name + 2];
    std::from_chars(text.data() + after_name + 4, text.data() + text.size(), stat.parent);
    return stat;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

}  // namespace

Process::Process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const Options& options)
    : name_(program.filename().string()), begin_(SteadyClock::now()) {
    const auto out = make_pipe();
    const auto err = make_pipe();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
    if (!options.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());

    std::vector<std::string> all{program.string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<std::string> environment = options.environment;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        const std::string name = text.substr(0, text.find('=') + 1);
        if (std::none_of(options.environment.begin(), options.environment.end(),
                         [&](const std::string& set) { return set.starts_with(name); }))
            environment.push_back(text);
    }
    const int error = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, pointers(all).data(),
                                    pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    ::close(out[1]);
    ::close(err[1]);
    out_.fd = out[0];
    err_.fd = err[0];
    if (error != 0) {
        pid_ = -1;
        fail_with_errno(program.string(), error);
    }
    exit_fd_ = open_process(pid_);
    if (exit_fd_ < 0) fail_with_errno("pidfd_open", errno);
}

Process::~Process() {
    kill_all();
    for (const int fd : {out_.fd, err_.fd, exit_fd_})
        if (fd >= 0) ::close(fd);
}

void Process::signal(int number) const {
    if (!ended_) ::kill(pid_, number);
}

// Reads new output once, and sees whether the program has ended; false when the time is up.
bool Process::pump(SteadyClock::time_point deadline) {
    std::array<pollfd, 3> waits{pollfd{out_.fd, POLLIN, 0}, pollfd{err_.fd, POLLIN, 0},
                                pollfd{ended_ ? -1 : exit_fd_, POLLIN, 0}};
    const int ready = ::poll(waits.data(), waits.size(), milliseconds_until(deadline));
    if (ready < 0 && errno != EINTR) fail_with_errno("poll", errno);
    // Looks for the end first: all output before it is then in the pipes.
    if (waits[2].revents != 0 && ::waitpid(pid_, &status_, WNOHANG) == pid_) {
        ended_ = true;
        end_ = SteadyClock::now();
    }
    for (Pipe* pipe : {&out_, &err_}) {
        std::array<char, 65536> piece;
        for (;;) {
            const ssize_t got = pipe->fd < 0 ? -1 : ::read(pipe->fd, piece.data(), piece.size());
            if (got == 0) {
                ::close(pipe->fd);
                pipe->fd = -1;
            }
            if (got <= 0) break;
            pipe->text.append(piece.data(), static_cast<std::size_t>(got));
        }
    }
    return ready > 0;
}

void Process::give_up(const std::string& what) {
    kill_all();
    throw std::runtime_error(name_ + ": " + what + "\nstdout:\n" + out_.text + "stderr:\n" + err_.text);
}

void Process::kill_all() {
    if (ended_ || pid_ < 0) return;
    const std::vector<pid_t> all = living_descendants(pid_);
    ::kill(pid_, SIGKILL);
    for (const pid_t child : all) ::kill(child, SIGKILL);
    ::waitpid(pid_, &status_, 0);
    ended_ = true;
    all_end_within(all, kDying);
}

std::string Process::wait_for_line(const std::string& text, std::chrono::milliseconds limit) {
    const auto deadline = SteadyClock::now() + limit;
    for (bool more = true;;) {
        for (const Pipe* pipe : {&out_, &err_}) {
            const auto found = pipe->text.find(text);
            const auto end = pipe->text.find('\n', found);
            if (found == std::string::npos || end == std::string::npos) continue;
            const auto before = found == 0 ? std::string::npos : pipe->text.rfind('\n', found - 1);
            const auto begin = before == std::string::npos ? 0 : before + 1;
            return pipe->text.substr(begin, end - begin);
        }
        if (ended_) give_up("ended without writing '" + text + "'");
        if (!more) give_up("did not write '" + text + "' within " + std::to_string(limit.count()) + " ms");
        more = pump(deadline);
    }
}

Finished Process::wait(std::chrono::milliseconds limit) {
    const auto deadline = SteadyClock::now() + limit;
    while (!ended_)
        if (!pump(deadline) && !ended_)
            give_up("did not end within " + std::to_string(limit.count()) + " ms");
    pump(SteadyClock::now());
    Finished finished;
    if (WIFEXITED(status_)) finished.exit_code = WEXITSTATUS(status_);
    if (WIFSIGNALED(status_)) finished.signal = WTERMSIG(status_);
    finished.out = out_.text;
    finished.err = err_.text;
    finished.took = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - begin_);
    return finished;
}

std::vector<pid_t> living_descendants(pid_t ancestor) {
    std::vector<std::pair<pid_t, Stat>> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        pid_t pid = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
        if (error == std::errc{} && end == name.data() + name.size()) all.emplace_back(pid, stat_of(pid));
    }
    std::vector<pid_t> family{ancestor};
    for (std::size_t i = 0; i < family.size(); ++i)
        for (const auto& [pid, stat] : all)
            if (stat.parent == family[i]) family.push_back(pid);
    family.erase(family.begin());
    std::erase_if(family, [&](pid_t pid) {
        return std::any_of(all.begin(), all.end(), [&](const auto& entry) {
            return entry.first == pid && (entry.second.state == 'Z' || entry.second.state == 'X');
        });
    });
    std::sort(family.begin(), family.end());
    return family;
}

std::string program_of(pid_t pid) {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", error).filename().string();
}

bool all_end_within(const std::vector<pid_t>& pids, std::chrono::milliseconds limit) {
    const auto deadline = SteadyClock::now() + limit;
    return std::all_of(pids.begin(), pids.end(), [&](pid_t pid) {
        const int fd = open_process(pid);
        if (fd < 0) return errno == ESRCH;
        pollfd wait{fd, POLLIN, 0};
        const int ready = ::poll(&wait, 1, milliseconds_until(deadline));
        ::close(fd);
        return ready > 0;
    });
}

void adopt_orphans() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

}  // namespace swath::test

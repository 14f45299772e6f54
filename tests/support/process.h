#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace swath::test {

// The end of a program, and its output.
struct Finished {
    int exit_code = -1;  // -1 if a signal ended it
    int signal = 0;      // that signal
    std::string out;
    std::string err;
    std::chrono::milliseconds took{0};
};

// A program run as a child process: without a shell, stdin empty, stdout and stderr kept. Output is read
// while one of the waiting functions runs; the pipes hold a megabyte besides. The destructor kills the
// program and everything that it has started. Waiting throws std::runtime_error, with the output so far, when
// the time is up; the program and its children are killed first. Not thread-safe.
class Process {
  public:
    struct Options {
        std::vector<std::string> environment;  // "NAME=VALUE", over our own
        std::filesystem::path folder;          // to run in; empty: ours
    };
    Process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
            const Options& options);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t pid() const { return pid_; }
    void signal(int number) const;
    // Waits for a line of stdout or stderr that contains `text`, and returns it; the line may be an old one.
    std::string wait_for_line(const std::string& text, std::chrono::milliseconds limit);
    // Waits until the program has ended; its children may live on.
    Finished wait(std::chrono::milliseconds limit);

  private:
    struct Pipe {
        int fd = -1;
        std::string text;
    };
    bool pump(std::chrono::steady_clock::time_point deadline);
    [[noreturn]] void give_up(const std::string& what);
    void kill_all();

    std::string name_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point end_;
    pid_t pid_ = -1;
    int exit_fd_ = -1;  // readable when the program has ended
    int status_ = 0;
    bool ended_ = false;
    Pipe out_;
    Pipe err_;
};

// The processes that `ancestor` has started, their children and so on, that have not ended; by ascending id.
std::vector<pid_t> living_descendants(pid_t ancestor);
// "swath-server"; empty when it is gone.
std::string program_of(pid_t pid);
// True if all of these, which are ours or our descendants', end before the time is up.
bool all_end_within(const std::vector<pid_t>& pids, std::chrono::milliseconds limit);
// Makes orphans among our descendants our children, so that living_descendants(getpid()) finds them.
void adopt_orphans();

}  // namespace swath::test

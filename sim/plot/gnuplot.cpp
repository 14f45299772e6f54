#include "sim/plot/gnuplot.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace swath::sim {
namespace {

constexpr std::size_t kMaxText = 80;  // bytes of a name in a picture

// A file in memory. A child can read or write it without either of us waiting for the other.
class MemoryFile {
  public:
    MemoryFile() : fd_(::memfd_create("gnuplot", MFD_CLOEXEC)) {}
    ~MemoryFile() {
        if (fd_ >= 0) ::close(fd_);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int fd() const { return fd_; }

    bool fill(std::string_view text) {
        while (!text.empty()) {
            const ssize_t put = ::write(fd_, text.data(), text.size());
            if (put < 0 && errno == EINTR) continue;
            if (put <= 0) return false;
            text.remove_prefix(static_cast<std::size_t>(put));
        }
        return ::lseek(fd_, 0, SEEK_SET) == 0;
    }

    // All bytes, or as many as could be read.
    Buffer contents() const {
        const off_t size = ::lseek(fd_, 0, SEEK_END);
        Buffer bytes(size > 0 ? static_cast<std::size_t>(size) : 0);
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t got =
                ::pread(fd_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            done += static_cast<std::size_t>(got);
        }
        bytes.resize(done);
        return bytes;
    }

  private:
    int fd_;
};

// Our environment, but with an English locale for texts and numbers.
std::vector<char*> environment() {
    static std::array locale{std::string("LC_ALL=C.UTF-8")};
    std::vector<char*> all;
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (!std::string_view(*entry).starts_with("LC_ALL=")) all.push_back(*entry);
    all.push_back(locale[0].data());
    all.push_back(nullptr);
    return all;
}

// The number of bytes of the UTF-8 character that `text` begins with; 0 if it is none.
std::size_t character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0x80   ? 1
                             : byte(0) < 0xc2 ? 0
                             : byte(0) < 0xe0 ? 2
                             : byte(0) < 0xf0 ? 3
                                              : 4;
    if (size == 0 || byte(0) > 0xf4 || text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    // Rejects overlong forms, surrogates, and numbers above the last character.
    if ((byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xed && byte(1) > 0x9f) ||
        (byte(0) == 0xf0 && byte(1) < 0x90) || (byte(0) == 0xf4 && byte(1) > 0x8f))
        return 0;
    return size;
}

// The first line of gnuplot's errors that says what is wrong.
std::string complaint(const Buffer& errors) {
    std::string_view text(reinterpret_cast<const char*>(errors.data()), errors.size());
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (const std::size_t at = line.find("line "); at != std::string_view::npos)
            return std::string(line.substr(at));
    }
    return "no reason given";
}

}  // namespace

std::string printable(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t size = character(text);
        const std::size_t taken = std::max<std::size_t>(size, 1);
        if (out.size() + taken > kMaxText) return out + "...";
        if (size == 0)
            out += '?';
        else if (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7f)
            out += ' ';
        else if (text[0] == '>' && out.ends_with("]]"))
            out += " >";  // gnuplot does not escape it, and XML forbids it
        else
            out += text.substr(0, size);
        text.remove_prefix(taken);
    }
    return out;
}

std::string literal(std::string_view text) {
    // Of gnuplot's ways to quote, only octal numbers leave nothing to interpret.
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == ' ';
        out += is_plain ? std::string(1, c) : fmt::format("\\{:03o}", byte);
    }
    return out + '"';
}

Result<Buffer> run_gnuplot(std::string_view script) {
    MemoryFile in;
    const MemoryFile out;
    const MemoryFile errors;
    if (in.fd() < 0 || out.fd() < 0 || errors.fd() < 0 || !in.fill(script))
        return fail("cannot run gnuplot: {}", std::strerror(errno));

    posix_spawn_file_actions_t actions;
    if (::posix_spawn_file_actions_init(&actions) != 0) return fail("cannot run gnuplot: out of memory");
    // The child's copies stay open.
    ::posix_spawn_file_actions_adddup2(&actions, in.fd(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, out.fd(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors.fd(), STDERR_FILENO);
    std::array<std::string, 3> words{"gnuplot", "--default-settings", "-"};
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t pid = -1;
    const int error =
        ::posix_spawnp(&pid, words[0].c_str(), &actions, nullptr, arguments.data(), environment().data());
    ::posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT) return fail("gnuplot is not installed: plots need it (Debian: gnuplot-nox)");
    if (error != 0) return fail("cannot run gnuplot: {}", std::strerror(error));

    int status = 0;
    while (::waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) return fail("cannot wait for gnuplot: {}", std::strerror(errno));
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return fail("gnuplot failed: {}", complaint(errors.contents()));
    Buffer picture = out.contents();
    if (picture.empty()) return fail("gnuplot drew nothing: {}", complaint(errors.contents()));
    return picture;
}

}  // namespace swath::sim

#include "common/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace swath {
namespace {

// A file descriptor that closes itself.
struct Descriptor {
    explicit Descriptor(int value) : fd(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    int fd;
};

}  // namespace

Result<Buffer> read_file(const std::filesystem::path& path, std::uint64_t limit) {
    // With O_NONBLOCK, opening a pipe does not wait for a writer. Regular files ignore it.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.fd < 0) return fail("{}: {}", path.string(), std::strerror(errno));
    struct stat status {};
    if (::fstat(file.fd, &status) != 0) return fail("{}: {}", path.string(), std::strerror(errno));
    if (!S_ISREG(status.st_mode)) return fail("{}: not a regular file", path.string());
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > limit) return fail("{}: {} bytes, the limit is {}", path.string(), size, limit);

    Buffer bytes(static_cast<std::size_t>(size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(file.fd, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail("{}: {}", path.string(), std::strerror(errno));
        if (got == 0)
            return fail("{}: ended after {} of {} bytes while being read", path.string(), done, size);
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    std::error_code error;
    if (path.has_parent_path()) {
        std::filesystem::create_directories(path.parent_path(), error);
        if (error) return fail("{}: {}", path.parent_path().string(), error.message());
    }
    std::string temporary = path.string() + ".XXXXXX";
    const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
    if (file.fd < 0) return fail("{}: {}", path.string(), std::strerror(errno));
    const auto give_up = [&](int code) {
        ::unlink(temporary.c_str());
        return fail("{}: {}", path.string(), std::strerror(code));
    };
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = ::write(file.fd, bytes.data() + done, bytes.size() - done);
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return give_up(errno);
        done += static_cast<std::size_t>(put);
    }
    if (::fchmod(file.fd, 0644) != 0) return give_up(errno);
    if (::rename(temporary.c_str(), path.c_str()) != 0) return give_up(errno);
    return {};
}

Status write_file(const std::filesystem::path& path, std::string_view text) {
    return write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace swath

#include "sim/sweep/journal_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/base/check.h"
#include "common/base/file.h"

namespace swath::sim {
namespace {

constexpr std::uint64_t kMaxBytes = 256 << 20;

// Makes sure that a new file in the folder is still there after a power loss.
void sync_folder(const std::filesystem::path& folder) {
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return;
    ::fsync(fd);
    ::close(fd);
}

}  // namespace

Result<std::unique_ptr<JournalFile>> JournalFile::open(const std::filesystem::path& path,
                                                       const std::string& head, std::span<const Row> labels) {
    // O_NONBLOCK: if somebody has made a pipe of this name, open() must not wait.
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0644);
    if (fd < 0) return fail("{}: {}", path.string(), std::strerror(errno));
    std::unique_ptr<JournalFile> file(new JournalFile(path, fd));
    SWATH_TRY_VOID(file->begin(head, labels));
    return file;
}

JournalFile::~JournalFile() { ::close(fd_); }

Status JournalFile::begin(const std::string& head, std::span<const Row> labels) {
    if (::flock(fd_, LOCK_EX | LOCK_NB) != 0)
        return errno == EWOULDBLOCK ? fail("{}: another sweep is at work in this folder", path_.string())
                                    : fail("{}: {}", path_.string(), std::strerror(errno));
    SWATH_TRY(const auto bytes, read_file(path_, kMaxBytes));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    SWATH_TRY(auto contents, read_journal(text, head, labels, path_.string()));
    rows_ = std::move(contents.rows);
    was_cut_off_ = contents.intact_bytes < text.size();
    if (was_cut_off_ && ::ftruncate(fd_, static_cast<off_t>(contents.intact_bytes)) != 0)
        return fail("{}: {}", path_.string(), std::strerror(errno));
    if (contents.intact_bytes > 0) return {};
    sync_folder(path_.parent_path());
    return write(head);
}

Status JournalFile::append(std::size_t experiment, std::string rows) {
    CHECK(!broken_);
    CHECK(rows_.at(experiment).empty());
    auto status = write(journal_entry(rows));
    broken_ = !status;
    if (status) rows_[experiment] = std::move(rows);
    return status;
}

Status JournalFile::write(std::string_view text) {
    while (!text.empty()) {
        const ssize_t put = ::write(fd_, text.data(), text.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return fail("{}: {}", path_.string(), std::strerror(errno));
        text.remove_prefix(static_cast<std::size_t>(put));
    }
    if (::fdatasync(fd_) != 0) return fail("{}: {}", path_.string(), std::strerror(errno));
    return {};
}

}  // namespace swath::sim

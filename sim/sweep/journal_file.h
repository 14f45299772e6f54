#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "sim/sweep/journal.h"

namespace swath::sim {

// The journal of a sweep on disk. The file is locked for as long as this lives: a second sweep is refused,
// and the lock ends with the process however that ends. One thread at a time.
class JournalFile {
  public:
    // Begins the file, or reads it and removes an entry that was cut off. An error changes nothing. `head`
    // and `labels` are as for read_journal().
    static Result<std::unique_ptr<JournalFile>> open(const std::filesystem::path& path,
                                                     const std::string& head, std::span<const Row> labels);
    ~JournalFile();
    JournalFile(const JournalFile&) = delete;
    JournalFile& operator=(const JournalFile&) = delete;

    // By experiment: its lines in the table; empty if it is not complete.
    const std::vector<std::string>& rows() const { return rows_; }
    bool was_cut_off() const { return was_cut_off_; }

    // Returns when the rows are on disk. After an error nothing more may be appended (CHECKed).
    Status append(std::size_t experiment, std::string rows);

  private:
    JournalFile(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
    Status begin(const std::string& head, std::span<const Row> labels);
    Status write(std::string_view text);

    std::filesystem::path path_;
    int fd_;
    std::vector<std::string> rows_;
    bool was_cut_off_ = false;
    bool broken_ = false;
};

}  // namespace swath::sim

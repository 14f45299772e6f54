#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "common/base/buffer.h"
#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/image/picture.h"

namespace swath {

// The format of a path that names one picture and not a folder: it ends in .png, .jpg or .jpeg, and no folder of
// that name exists.
std::optional<PictureFormat> format_of_file(const std::filesystem::path& path);

// Writes a run's pictures to FOLDER/frame_0000.png and so on, or the only one to the file that is named; each
// file is whole or absent. Without a path it writes none.
class PictureWriter {
  public:
    // Fails where a file is named and the run has more frames than one.
    static Result<PictureWriter> make(std::filesystem::path path, PictureFormat format, std::size_t frames);

    Status write(FrameNumber frame, const Buffer& encoded) const;
    // For people: what was kept and where, and how many pictures of earlier runs lie beside it.
    std::string summary() const;

  private:
    PictureWriter(std::filesystem::path path, PictureFormat format, std::size_t frames)
        : path_(std::move(path)),
          format_(format),
          frames_(frames),
          is_file_(format_of_file(path_).has_value()) {}
    std::string name_of(FrameNumber frame) const;
    std::size_t count_others() const;

    std::filesystem::path path_;
    PictureFormat format_;
    std::size_t frames_;
    bool is_file_;
};

}  // namespace swath

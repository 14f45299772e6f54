#pragma once
#include <filesystem>
#include <string>

#include "common/base/buffer.h"
#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/image/picture.h"

namespace swath {

// Writes a run's pictures to FOLDER/frame_0000.png and so on; each file is whole or absent. Without a folder
// it writes none.
class PictureWriter {
  public:
    PictureWriter(std::filesystem::path folder, PictureFormat format)
        : folder_(std::move(folder)), format_(format) {}
    Status write(FrameNumber frame, const Buffer& encoded) const;

  private:
    std::filesystem::path folder_;
    PictureFormat format_;
};

}  // namespace swath

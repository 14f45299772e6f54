#pragma once
#include <filesystem>
#include <string>

#include "common/base/buffer.h"
#include "common/base/ids.h"
#include "common/base/result.h"
#include "common/image/picture.h"

namespace swath {

// Keeps a run's pictures as DIR/frame_0000.png and so on; each file is whole or not there. Without a folder
// it keeps none.
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

#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "common/image/picture.h"

namespace swath {

// Keeps pictures for reuse, so that megabytes need not be allocated for each frame. A picture comes back when
// its last holder releases it, on whichever thread that is, and may outlive the pool. Any thread.
class PicturePool {
  public:
    // The picture has old contents; the caller fills it.
    std::shared_ptr<Picture> take();

  private:
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<Picture>> pictures;  // mutex guards this
        std::size_t out = 0;                             // and this: how many are out
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace swath

#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "common/image/picture.h"

namespace swath {

// Pictures that are used again, so that megabytes need not be allocated for each frame. A picture goes back
// when its last holder lets it go, on whichever thread that is, and may outlive the pool. Any thread.
class PicturePool {
  public:
    // It holds what it held: whoever takes it fills it.
    std::shared_ptr<Picture> take();

  private:
    struct Shelf {
        std::mutex mutex;
        std::vector<std::unique_ptr<Picture>> pictures;  // guarded by mutex, as is
        std::size_t out = 0;                             // how many are out
    };
    std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace swath

#include "display/session/picture_pool.h"

#include <utility>

namespace swath {

std::shared_ptr<Picture> PicturePool::take() {
    std::unique_ptr<Picture> picture;
    {
        const std::lock_guard lock(shelf_->mutex);
        if (!shelf_->pictures.empty()) {
            picture = std::move(shelf_->pictures.back());
            shelf_->pictures.pop_back();
        }
        // Makes room for its return, which must not fail.
        shelf_->pictures.reserve(shelf_->pictures.size() + ++shelf_->out);
    }
    if (!picture) picture = std::make_unique<Picture>();
    return {picture.release(), [shelf = std::weak_ptr(shelf_)](Picture* back) {
                std::unique_ptr<Picture> owned(back);
                const auto there = shelf.lock();
                if (!there) return;
                const std::lock_guard lock(there->mutex);
                --there->out;
                there->pictures.push_back(std::move(owned));
            }};
}

}  // namespace swath

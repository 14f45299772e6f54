#include "client/report/picture_writer.h"

#include "common/base/file.h"

namespace swath {

Status PictureWriter::write(FrameNumber frame, const Buffer& encoded) const {
    if (folder_.empty()) return {};
    return write_file(folder_ / fmt::format("frame_{:04}.{}", frame, file_extension(format_)),
                      encoded.bytes());
}

}  // namespace swath

#include "client/report/picture_writer.h"

#include <charconv>

#include "common/base/file.h"

namespace swath {

namespace fs = std::filesystem;

std::optional<PictureFormat> format_of_file(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return std::nullopt;
    const fs::path ending = path.extension();
    if (ending == ".png") return PictureFormat::kPng;
    if (ending == ".jpg" || ending == ".jpeg") return PictureFormat::kJpeg;
    return std::nullopt;
}

Result<PictureWriter> PictureWriter::make(fs::path path, PictureFormat format, std::size_t frames) {
    const PictureWriter writer(std::move(path), format, frames);
    if (writer.is_file_ && frames != 1)
        return fail("--out: {} is one picture, and there are {} frames: name a folder, or say --frames 1",
                    writer.path_.string(), frames);
    return writer;
}

Status PictureWriter::write(FrameNumber frame, const Buffer& encoded) const {
    if (path_.empty()) return {};
    return write_file(is_file_ ? path_ : path_ / name_of(frame), encoded.bytes());
}

std::string PictureWriter::name_of(FrameNumber frame) const {
    return fmt::format("frame_{:04}.{}", frame, file_extension(format_));
}

std::size_t PictureWriter::count_others() const {
    constexpr std::string_view kPrefix = "frame_";
    std::error_code error;
    std::size_t others = 0;
    for (fs::directory_iterator at(path_, error), end; !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(kPrefix) || !format_of_file(at->path())) continue;
        FrameNumber frame = 0;
        std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), frame);
        if (frame >= frames_ || name != name_of(frame)) ++others;
    }
    return others;
}

std::string PictureWriter::summary() const {
    if (path_.empty()) return "none kept (--out FOLDER keeps them)";
    if (is_file_) return path_.string();
    const std::size_t others = count_others();
    return fmt::format("{} in {}/", frames_, path_.string()) +
           (others > 0 ? fmt::format(", beside {} of earlier runs", others) : "");
}

}  // namespace swath

#include "sim/studies/pictures.h"

#include "common/base/file.h"
#include "sim/picture/render_view.h"

namespace swath::sim {
namespace {

constexpr Rgb kBackground{16, 18, 24};

View first_view(const StudySubject& subject) {
    return make_view(subject.paths.front().front(), kPaperWidth, kPaperHeight);
}

}  // namespace

Result<Picture> first_frame(const StudySubject& subject) {
    return render_view(subject.model.scene, first_view(subject), kBackground);
}

FramePlan first_plan(const StudySubject& subject, const StudyModel& model, Algorithm algorithm,
                     std::size_t servers) {
    const View view = first_view(subject);
    const auto objects = project(model.scene.objects, view);
    return make_partitioner(algorithm, model.scene.objects)->partition({0, view, objects, servers});
}

Status write_picture(const StudyContext& context, const Picture& picture, const std::string& file) {
    return write_file(context.options().out / file, encode(picture, PictureFormat::kPng).bytes());
}

}  // namespace swath::sim

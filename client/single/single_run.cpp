#include "client/single/single_run.h"

#include <numeric>

#include "common/cull/frustum_cull.h"
#include "common/image/pixel_codec.h"
#include "common/timeline/phase_timer.h"

namespace swath {

Result<std::vector<FrameTimeline>> render_single(
    const SingleJob& job, const Clock& clock,
    const std::function<Status(FrameNumber, const Buffer&)>& on_picture) {
    auto renderer = make_renderer(job.renderer, *job.scene);
    if (!renderer) return tl::unexpected(renderer.error());
    std::vector<ObjectId> all(job.scene->objects.size());
    std::iota(all.begin(), all.end(), ObjectId{0});

    std::vector<FrameTimeline> timelines;
    PixelFrame pixels;
    for (FrameNumber number = 0; number < job.cameras.size(); ++number) {
        MachineTimeline machine;
        machine.machine = kSingleMachine;
        PhaseTimer timer(clock, machine.spans);
        const View view = make_view(job.cameras[number], job.width, job.height);
        const auto visible = cull(job.scene->objects, all, view);
        machine[Counter::kObjects] = visible.size();
        for (const ObjectId id : visible)
            machine[Counter::kTriangles] += job.scene->objects[id].triangle_count;
        timer.end(Phase::kCull);
        if (const auto status = (*renderer)->draw(visible, view, view.viewport()); !status)
            return tl::unexpected(status.error());
        timer.end(Phase::kRender);
        pixels.reshape(view.viewport());
        if (const auto status = (*renderer)->read(view.viewport(), pixels); !status)
            return tl::unexpected(status.error());
        timer.end(Phase::kPixelRead);
        const Picture picture = to_picture(pixels, job.background);
        timer.end(Phase::kAssemble);
        Buffer encoded;
        if (job.format != PictureFormat::kNone) {
            encoded = encode(picture, job.format);
            timer.end(Phase::kEncode);
        }
        FrameTimeline timeline;
        timeline.frame = number;
        timeline.machines.push_back(std::move(machine));
        timelines.push_back(std::move(timeline));
        if (const auto status = on_picture(number, encoded); !status) return tl::unexpected(status.error());
    }
    return timelines;
}

}  // namespace swath

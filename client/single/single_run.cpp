#include "client/single/single_run.h"

#include <numeric>

#include "client/path/path.h"
#include "common/cullers/make_culler.h"
#include "common/image/pixel_codec.h"
#include "common/renderers/make_renderer.h"
#include "common/timeline/phase_timer.h"

namespace swath {

Result<std::vector<FrameTimeline>> render_single(
    const SingleJob& job, const Clock& clock,
    const std::function<Status(FrameNumber, const Buffer&)>& on_picture) {
    SWATH_TRY(auto renderer, make_renderer(job.renderer, *job.scene));
    std::vector<ObjectId> all(job.scene->objects.size());
    ThreadTeam team(job.renderer.threads, clock);
    LeafCull cull = make_leaf_cull(job.cull, *job.scene, team);
    std::iota(all.begin(), all.end(), ObjectId{0});

    std::vector<FrameTimeline> timelines;
    PixelFrame pixels;
    for (FrameNumber number = 0; number < job.cameras.size(); ++number) {
        MachineTimeline machine;
        machine.machine = kSingleMachine;
        PhaseTimer timer(clock, machine.spans);
        View view = make_view(job.cameras[number], job.width, job.height);
        view.pose = job.pose.value_or(path_pose(number));
        if (job.to_light) view.to_light = *job.to_light;
        const CullResult list = cull.cull(all, view, view.viewport());
        machine[Counter::kTriangles] = list.triangles;
        machine[Counter::kObjects] = list.objects;
        machine[Counter::kLeaves] = list.leaves;
        machine[Counter::kSplitLevel] = static_cast<std::uint64_t>(list.split_level.value_or(0));
        timer.end(Phase::kCull);
        SWATH_TRY_VOID(renderer->draw(list.ranges, view, view.viewport()));
        timer.end(Phase::kRender);
        pixels.reshape(view.viewport());
        SWATH_TRY_VOID(renderer->read(view.viewport(), pixels));
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
        SWATH_TRY_VOID(on_picture(number, encoded));
    }
    return timelines;
}

}  // namespace swath

#include "server/session/draw_thread.h"

#include <new>

#include "common/timeline/phase_timer.h"

namespace swath {

DrawThread::~DrawThread() {
    // The renderer dies where it lived. (The destructor of thread_ drops what is queued, so wait for this
    // one.)
    std::mutex mutex;
    std::condition_variable gone;
    bool done = false;
    thread_.post([&] {
        renderer_.reset();
        const std::lock_guard lock(mutex);
        done = true;
        gone.notify_one();
    });
    std::unique_lock lock(mutex);
    gone.wait(lock, [&] { return done; });
}

void DrawThread::load(Mesh mesh, int octree_depth, CullAlgorithm cull, RendererKind kind,
                      std::function<void(Result<Loaded>)> done) {
    thread_.post([this, mesh = std::make_shared<Mesh>(std::move(mesh)), octree_depth, cull, kind,
                  done = std::move(done)] {
        try {
            scene_ = build_objects(std::move(*mesh), {octree_depth, 0});
            team_ = std::make_unique<ThreadTeam>(cull == CullAlgorithm::kNone ? 1 : cull_threads_, clock_);
            cull_ = std::make_unique<LeafCull>(cull, scene_, *team_);
            auto renderer = factory_(kind, scene_);
            if (!renderer) return done(tl::unexpected(renderer.error()));
            renderer_ = std::move(*renderer);
            done(Loaded{scene_.objects.size(), scene_.mesh.triangle_count(), renderer_->description()});
        } catch (const std::bad_alloc&) {
            done(fail("not enough memory for the model"));
        }
    });
}

void DrawThread::draw(DrawJob job, std::function<void(Drawn)> done) {
    thread_.post([this, job = std::make_shared<DrawJob>(std::move(job)), done = std::move(done)] {
        try {
            done(draw_now(std::move(*job)));
        } catch (const std::bad_alloc&) {
            Drawn drawn;
            drawn.status = fail("not enough memory for a frame");
            done(std::move(drawn));
        }
    });
}

Drawn DrawThread::draw_now(DrawJob job) {
    Drawn out;
    PhaseTimer timer(clock_, out.spans);
    out.list = cull_->cull(job.group, job.view, job.content);
    timer.end(Phase::kCull);

    if (!job.content.empty()) out.status = renderer_->draw(out.list.runs, job.view, job.content);
    timer.end(Phase::kRender);

    // The frame covers what was drawn and what will be received; the latter starts as background.
    Rect cover = job.content;
    for (const Rect& r : job.final_region) cover = bounding(cover, r);
    job.pixels.reshape(cover);
    for (const Rect& r : job.final_region)
        for (const Rect& rest : subtract(r, job.content)) job.pixels.clear(rest);
    if (out.status && !job.content.empty()) out.status = renderer_->read(job.content, job.pixels);
    timer.end(Phase::kPixelRead);
    out.pixels = std::move(job.pixels);
    return out;
}

}  // namespace swath

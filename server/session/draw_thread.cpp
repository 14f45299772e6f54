#include "server/session/draw_thread.h"

#include <new>

#include "common/cullers/make_culler.h"
#include "common/timeline/phase_timer.h"

namespace swath {

DrawThread::~DrawThread() {
    // The renderer must be destroyed on its thread. (The destructor of thread_ drops queued tasks, so waits
    // here for this one.)
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

// Renderer and culling belong to a scene, so a new scene needs new ones. The old renderer goes first: a
// thread cannot have two.
Status DrawThread::configure(const Drawing& drawing) {
    const bool cut = drawing.cut != scene_.cut;
    if (cut || setup_of(drawing) != setup_of(drawing_)) renderer_.reset();
    if (cut) {
        cull_.reset();
        scene_ = build_objects(std::move(scene_.mesh), granularity_of(drawing.cut));
    }
    if (!cull_ || drawing.cull != drawing_.cull) {
        cull_.reset();
        team_ = std::make_unique<ThreadTeam>(drawing.cull == CullAlgorithm::kNone ? 1 : threads_, clock_);
        cull_ = std::make_unique<LeafCull>(make_leaf_cull(drawing.cull, scene_, *team_));
    }
    drawing_ = drawing;
    if (renderer_) return {};
    SWATH_TRY(renderer_, factory_(setup_of(drawing), scene_));
    return {};
}

RendererSetup DrawThread::setup_of(const Drawing& drawing) const {
    return {drawing.renderer_of(server_), drawing.flags, threads_};
}

SceneInfo DrawThread::loaded() const {
    return {scene_.objects.size(), scene_.mesh.triangle_count(), renderer_->description(), drawing_, {}};
}

void DrawThread::load(Mesh mesh, ServerId server, const Drawing& drawing,
                      std::function<void(Result<SceneInfo>)> done) {
    thread_.post(
        [this, mesh = std::make_shared<Mesh>(std::move(mesh)), server, drawing, done = std::move(done)] {
            try {
                server_ = server;
                scene_ = build_objects(std::move(*mesh), granularity_of(drawing.cut));
                if (const auto status = configure(drawing); !status)
                    return done(tl::unexpected(status.error()));
                done(loaded());
            } catch (const std::bad_alloc&) {
                done(fail("not enough memory for the model"));
            }
        });
}

void DrawThread::reconfigure(const Drawing& drawing, std::function<void(Result<SceneInfo>)> done) {
    thread_.post([this, drawing, done = std::move(done)] {
        try {
            const Drawing before = drawing_;
            const auto status = configure(drawing);
            if (status) return done(loaded());
            if (const auto back = configure(before); !back) return done(tl::unexpected(back.error()));
            SceneInfo as_before = loaded();
            as_before.refused = status.error().message;
            done(std::move(as_before));
        } catch (const std::bad_alloc&) {
            done(fail("not enough memory to cut the model anew"));
        }
    });
}

void DrawThread::draw(DrawJob job, std::function<void(DrawResult)> done) {
    thread_.post([this, job = std::make_shared<DrawJob>(std::move(job)), done = std::move(done)] {
        try {
            done(draw_now(std::move(*job)));
        } catch (const std::bad_alloc&) {
            DrawResult drawn;
            drawn.status = fail("not enough memory for a frame");
            done(std::move(drawn));
        }
    });
}

DrawResult DrawThread::draw_now(DrawJob job) {
    DrawResult out;
    PhaseTimer timer(clock_, out.spans);
    out.list = cull_->cull(job.group, job.view, job.content);
    timer.end(Phase::kCull);

    if (!job.content.empty()) out.status = renderer_->draw(out.list.ranges, job.view, job.content);
    timer.end(Phase::kRender);

    // The frame covers the content and the final region; the part that only comes from others starts as
    // background.
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

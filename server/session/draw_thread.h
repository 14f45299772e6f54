#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/base/clock.h"
#include "common/base/result.h"
#include "common/base/thread_team.h"
#include "common/base/worker_thread.h"
#include "common/cull/leaf_cull.h"
#include "common/image/pixel_frame.h"
#include "common/render/renderer.h"
#include "common/scene/objects.h"
#include "common/timeline/timeline.h"
#include "common/wire/messages.h"

namespace swath {

// The input of drawing a frame.
struct DrawJob {
    View view;
    std::vector<ObjectId> group;
    Rect content;
    Region final_region;
    PixelFrame pixels;  // a used one, for its memory
};
struct DrawResult {
    PixelFrame pixels;
    std::vector<Span> spans;  // cull, render, pixel read
    CullResult list;
    Status status;
};
struct SceneInfo {
    std::size_t objects = 0;
    std::size_t triangles = 0;
    std::string renderer;
    Drawing drawing;      // in effect
    std::string refused;  // why a reconfiguration failed; the rest is then as before
};

// Makes a server's renderer; benchmarks and tests bring their own.
using RendererFactory =
    std::function<Result<std::unique_ptr<Renderer>>(const RendererSetup&, const ObjectSet&)>;

// The thread that owns the scene and its renderer: the GL context is bound to it. It calls callbacks ON THIS
// THREAD, and they post the results on. The destructor waits for the job in progress.
class DrawThread {
  public:
    // So many threads cull and cast rays, this one among them; at least 1.
    DrawThread(RendererFactory factory, std::size_t threads, const Clock& clock)
        : factory_(std::move(factory)), clock_(clock), threads_(threads) {}
    ~DrawThread();

    // Runs something slow that needs no scene, e.g. reading a model.
    void post(std::function<void()> task) { thread_.post(std::move(task)); }
    // Cuts the mesh into objects and makes what culls and draws them, for this server of the run.
    void load(Mesh mesh, ServerId server, const Drawing& drawing,
              std::function<void(Result<SceneInfo>)> done);
    // Makes them anew; if that fails, goes back to those before. Fails only if there is no way back.
    void reconfigure(const Drawing& drawing, std::function<void(Result<SceneInfo>)> done);
    void draw(DrawJob job, std::function<void(DrawResult)> done);

  private:
    Status configure(const Drawing& drawing);
    RendererSetup setup_of(const Drawing& drawing) const;
    SceneInfo loaded() const;
    DrawResult draw_now(DrawJob job);

    RendererFactory factory_;
    const Clock& clock_;
    std::size_t threads_;
    std::unique_ptr<ThreadTeam> team_;    // thread_'s
    ObjectSet scene_;                     // thread_'s
    ServerId server_{};                   // of thread_; which of the drawing's renderers is ours
    Drawing drawing_;                     // thread_'s; in effect
    std::unique_ptr<LeafCull> cull_;      // thread_'s
    std::unique_ptr<Renderer> renderer_;  // thread_'s
    WorkerThread thread_;                 // last: its tasks use the rest
};

}  // namespace swath

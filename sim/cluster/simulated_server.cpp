#include "sim/cluster/simulated_server.h"

#include <algorithm>
#include <utility>

namespace swath::sim {

SimulatedServer::SimulatedServer(EventQueue& events, Compositing compositing, std::size_t frames_in_flight,
                                 Outside outside)
    : compositing_(compositing),
      outside_(std::move(outside)),
      swap_(frames_in_flight),
      draw_(events),
      host_(events) {}

void SimulatedServer::on_task(FrameNumber number, const ServerWork& work) {
    frames_[number].work = &work;
    SwapTask task{number, {}, work.incoming, work.has_tile};
    for (const SwathWork& swath : work.outgoing) task.outgoing.push_back(swath.peer);
    perform(decided(swap_.on_task(task)));
}

void SimulatedServer::on_swath(FrameNumber number, ServerId from, double merge_s) {
    frames_[number].merge_s[from] = merge_s;
    perform(decided(swap_.on_swath(number, from)));
}

void SimulatedServer::perform(const FrameSwap::Actions& actions) {
    for (const SwapAction& action : actions) {
        const FrameNumber number = action.frame;
        Frame& frame = frames_.at(number);
        switch (action.kind) {
            case SwapAction::Kind::kDraw:
                to_draw_.push_back(number);
                draw_next();
                break;
            case SwapAction::Kind::kSendSwath: {
                const auto swath =
                    std::find_if(frame.work->outgoing.begin(), frame.work->outgoing.end(),
                                 [&](const SwathWork& work) { return work.peer == action.peer; });
                work_on(pixel_station(), number, on_card() ? Phase::kPixelRead : Phase::kSwap, swath->send_s,
                        [this, number, &swath = *swath] { outside_.send_swath(number, swath); });
                break;
            }
            case SwapAction::Kind::kComposite:
                work_on(pixel_station(), number, Phase::kPixelWrite, frame.merge_s.at(action.peer), [] {});
                break;
            case SwapAction::Kind::kSendTile:
                work_on(pixel_station(), number, Phase::kFinalRead, frame.work->final_s,
                        [this, number] { outside_.send_tile(number); });
                break;
            case SwapAction::Kind::kFinished:
                pixel_station().submit(Nanoseconds(0),
                                       [this, number](Nanoseconds, Nanoseconds) { finish(number); });
                break;
        }
    }
}

void SimulatedServer::draw_next() {
    if (to_draw_.empty() || card_taken_) return;
    card_taken_ = on_card();
    const FrameNumber number = to_draw_.front();
    to_draw_.pop_front();
    const ServerWork& work = *frames_.at(number).work;
    const auto drawn = [this, number] { perform(swap_.on_drawn(number)); };
    if (on_card()) {
        work_on(draw_, number, Phase::kRender, work.render_s, drawn);
    } else {
        // Submits both at once, so that no other frame's drawing comes between.
        work_on(draw_, number, Phase::kRender, work.render_s, [] {});
        work_on(draw_, number, Phase::kPixelRead, work.read_s, drawn);
    }
}

void SimulatedServer::finish(FrameNumber number) {
    frames_.at(number).work = nullptr;
    card_taken_ = false;
    outside_.report(number);
    draw_next();
}

void SimulatedServer::work_on(Station& station, FrameNumber number, Phase phase, double duration_s,
                              std::function<void()> after) {
    station.submit(nanoseconds(duration_s),
                   [this, number, phase, after = std::move(after)](Nanoseconds begin, Nanoseconds end) {
                       if (end > begin) frames_.at(number).spans.push_back({phase, begin, end, end - begin});
                       after();
                   });
}

std::vector<Span> SimulatedServer::take_spans(FrameNumber number) {
    const auto found = frames_.find(number);
    if (found == frames_.end()) return {};
    std::vector<Span> spans = std::move(found->second.spans);
    frames_.erase(found);
    return spans;
}

}  // namespace swath::sim

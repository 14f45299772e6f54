#include "server/swap/frame_swap.h"

namespace swath {

Result<FrameSwap::Actions> FrameSwap::on_task(const SwapTask& task) {
    SWATH_TRY_VOID(gather_.open(task.frame, task.incoming));
    tasks_[task.frame] = {task.outgoing, task.has_tile};
    return Actions{{SwapAction::Kind::kDraw, task.frame, {}}};
}

FrameSwap::Actions FrameSwap::on_drawn(FrameNumber frame) {
    Actions actions;
    const auto arrived = gather_.ready(frame);
    for (const ServerId peer : tasks_.at(frame).outgoing)
        actions.push_back({SwapAction::Kind::kSendSwath, frame, peer});
    for (const ServerId peer : arrived) actions.push_back({SwapAction::Kind::kComposite, frame, peer});
    finish_if_complete(frame, actions);
    return actions;
}

Result<FrameSwap::Actions> FrameSwap::on_swath(FrameNumber frame, ServerId from) {
    SWATH_TRY(const auto now, gather_.arrive(frame, from));
    Actions actions;
    if (!now) return actions;
    actions.push_back({SwapAction::Kind::kComposite, frame, from});
    finish_if_complete(frame, actions);
    return actions;
}

void FrameSwap::finish_if_complete(FrameNumber frame, Actions& actions) {
    if (!gather_.complete(frame)) return;
    if (tasks_.at(frame).has_tile) actions.push_back({SwapAction::Kind::kSendTile, frame, {}});
    actions.push_back({SwapAction::Kind::kFinished, frame, {}});
    gather_.close(frame);
    tasks_.erase(frame);
}

}  // namespace swath

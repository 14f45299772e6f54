#include "display/assemble/assembly.h"

namespace swath {

Result<Assembly::Actions> Assembly::on_task(FrameNumber frame, const std::vector<ServerId>& servers) {
    SWATH_TRY_VOID(gather_.open(frame, servers));
    Actions actions;
    for (const ServerId server : gather_.ready(frame))
        actions.push_back({AssemblyAction::Kind::kAssemble, frame, server});
    finish_if_complete(frame, actions);
    return actions;
}

Result<Assembly::Actions> Assembly::on_tile(FrameNumber frame, ServerId from) {
    SWATH_TRY(const auto now, gather_.arrive(frame, from));
    Actions actions;
    if (!now) return actions;
    actions.push_back({AssemblyAction::Kind::kAssemble, frame, from});
    finish_if_complete(frame, actions);
    return actions;
}

void Assembly::finish_if_complete(FrameNumber frame, Actions& actions) {
    if (!gather_.complete(frame)) return;
    actions.push_back({AssemblyAction::Kind::kComplete, frame, {}});
    gather_.close(frame);
}

}  // namespace swath

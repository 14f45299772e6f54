#pragma once
#include <string>

#include "common/image/picture.h"
#include "common/plan/frame_plan.h"
#include "sim/studies/context.h"

namespace swath::sim {

inline constexpr std::size_t kPictureServers = 16;

// A picture of the subject's first frame.
Result<Picture> first_frame(const StudySubject& subject);
// The plan of that frame for `servers` servers.
FramePlan first_plan(const StudySubject& subject, const StudyModel& model, Algorithm algorithm,
                     std::size_t servers);
Status write_picture(const StudyContext& context, const Picture& picture, const std::string& file);

}  // namespace swath::sim

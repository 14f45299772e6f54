#include "client/partition/object_costs.h"

#include <algorithm>

#include "common/base/check.h"

namespace swath {

ObjectCosts::ObjectCosts(std::span<const Object> objects) {
    triangles_.reserve(objects.size());
    for (const Object& object : objects) triangles_.push_back(object.triangle_count);
    costs_ = triangles_;
}

void ObjectCosts::on_issued(FrameNumber frame, std::map<ServerId, std::vector<ObjectId>> groups) {
    for (const auto& [server, group] : groups)
        if (!group.empty()) CHECK(group.back() < triangles_.size());
    std::vector<std::uint32_t> sums(triangles_.size());
    if (groups.empty())
        close(frame, sums);
    else
        open_.insert_or_assign(frame, Open{std::move(groups), std::move(sums)});
}

Status ObjectCosts::on_report(FrameNumber frame, ServerId server, std::span<const std::uint32_t> visible) {
    const auto open = open_.find(frame);
    if (open == open_.end()) return fail("a report for frame {}, which is not open", frame);
    auto& [groups, sums] = open->second;
    const auto found = groups.find(server);
    if (found == groups.end()) return fail("a report for frame {} that is not awaited", frame);
    const std::vector<ObjectId>& group = found->second;
    if (!visible.empty() && visible.size() != group.size())
        return fail("visible: {} counts for a group of {} objects", visible.size(), group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
        const std::uint32_t all = triangles_[group[i]];
        const std::uint32_t seen = visible.empty() ? all : visible[i];
        if (seen > all) return fail("visible: {} triangles of object {}, which has {}", seen, group[i], all);
        std::uint32_t& sum = sums[group[i]];
        sum += std::min(seen, all - sum);
    }
    groups.erase(found);
    if (groups.empty()) {
        close(frame, sums);
        open_.erase(open);
    }
    return {};
}

void ObjectCosts::close(FrameNumber frame, const std::vector<std::uint32_t>& sums) {
    if (frame < next_) return;
    next_ = frame + 1;
    for (std::size_t i = 0; i < sums.size(); ++i) costs_[i] = sums[i] > 0 ? sums[i] : triangles_[i];
}

}  // namespace swath

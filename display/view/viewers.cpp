#include "display/view/viewers.h"

#include <algorithm>
#include <utility>

namespace swath {
namespace {

// In the order in which they are sent. A newcomer gets the newest of each sticky topic; a trace goes only to
// viewers who are there.
constexpr NoteTopic kNewestOnly[] = {NoteTopic::kSession, NoteTopic::kObjects, NoteTopic::kState,
                                     NoteTopic::kSpeedup, NoteTopic::kTrace};
bool sticky(NoteTopic topic) { return topic != NoteTopic::kTrace; }

std::size_t index(NoteTopic topic) { return static_cast<std::size_t>(topic); }
std::size_t index(ViewFormat format) { return static_cast<std::size_t>(format); }

}  // namespace

Viewers::Actions Viewers::on_join(ViewerId viewer, Nanoseconds now) {
    viewers_[viewer].notes = sticky_;
    if (lead_ == 0) lead_ = viewer;
    tell_audience();
    return settle(now);
}

Viewers::Actions Viewers::on_leave(ViewerId viewer, Nanoseconds now) {
    if (viewers_.erase(viewer) == 0) return {};
    if (viewer == lead_) lead_ = viewers_.empty() ? 0 : viewers_.begin()->first;
    tell_audience();
    return settle(now);
}

Viewers::Actions Viewers::on_lead(ViewerId viewer, Nanoseconds now) {
    if (!viewers_.contains(viewer) || viewer == lead_) return {};
    lead_ = viewer;
    tell_audience();
    return settle(now);
}

Viewers::Actions Viewers::on_written(ViewerId viewer, Nanoseconds now) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) return {};
    found->second.writing = Writing::kNothing;
    return settle(now);
}

Viewers::Actions Viewers::on_shown(ViewerId viewer, const PictureKey& shown, Nanoseconds now) {
    const auto found = viewers_.find(viewer);
    if (found == viewers_.end()) return {};
    auto& unshown = found->second.streams[shown.stream].unshown;
    const auto sent = std::find(unshown.begin(), unshown.end(), shown);
    if (sent == unshown.end()) return {};
    unshown.erase(unshown.begin(), sent + 1);
    return settle(now);
}

Viewers::Actions Viewers::on_session(bool live, Nanoseconds now) {
    ++run_;
    session_ = true;
    live_ = live;
    tell_audience();
    return settle(now);
}

Viewers::Actions Viewers::on_session_end(Nanoseconds now) {
    session_ = live_ = false;
    sticky_ = {};
    plans_.clear();
    announced_.clear();
    streams_ = {};
    rested_ = true;
    for (auto& [id, viewer] : viewers_) {
        viewer.notes = {};
        viewer.frame_notes.clear();
        viewer.streams = {};
    }
    tell_audience();
    return settle(now);
}

Viewers::Actions Viewers::on_note(NoteTopic topic, FrameNumber frame, SharedBytes text, Nanoseconds now) {
    if (topic == NoteTopic::kPlan) {
        plans_[frame] = std::move(text);
        if (plans_.size() > kMaxPlans) plans_.erase(plans_.begin());
        return {};
    }
    if (topic == NoteTopic::kFrame) {
        for (auto& [id, viewer] : viewers_) {
            viewer.frame_notes.push_back(text);
            if (viewer.frame_notes.size() > kMaxFrameNotes) viewer.frame_notes.pop_front();
        }
        return settle(now);
    }
    for (auto& [id, viewer] : viewers_) viewer.notes[index(topic)] = text;
    if (sticky(topic)) sticky_[index(topic)] = std::move(text);
    return settle(now);
}

void Viewers::on_announced(FrameNumber frame) { announced_.insert(frame); }

Viewers::Actions Viewers::on_picture(FrameNumber frame, std::uint32_t stream,
                                     std::shared_ptr<const Picture> picture, Nanoseconds now) {
    announced_.erase(frame);
    auto plan = plans_.extract(frame);
    completed_ = now;
    rested_ = false;
    Stream& of = streams_[stream];
    // Frames may overtake each other; an older one is of no use.
    if (!of.frame || *of.frame < frame) {
        of.frame = frame;
        of.picture = std::move(picture);
        of.plan = plan.empty() ? nullptr : std::move(plan.mapped());
        of.encoded = {};
    }
    return settle(now);
}

Viewers::Actions Viewers::on_encoded(const PictureKey& key, SharedBytes message, Nanoseconds now) {
    Stream& stream = streams_[key.stream];
    auto& encoding = stream.encoding[index(key.format)];
    if (encoding != key) return {};  // from a session that is over
    encoding.reset();
    const bool newest = stream.frame == key.frame;
    // The run has gone on, and PNG is only for pictures that stay.
    if (!newest && key.format == ViewFormat::kPng) return settle(now);
    if (newest) stream.encoded[index(key.format)] = message;
    for (auto& [id, viewer] : viewers_) {
        ViewerStream& of = viewer.streams[key.stream];
        if (of.unshown.size() < kMaxUnshown && (!of.given || *of.given < key)) give(viewer, key, message);
    }
    return settle(now);
}

std::optional<Nanoseconds> Viewers::deadline() const {
    if (viewers_.empty() || rested_ || !announced_.empty()) return std::nullopt;
    return completed_ + kRest;
}

std::size_t Viewers::waiting_bytes() const {
    std::size_t bytes = 0;
    const auto add = [&](const SharedBytes& one) { bytes += one ? one->size() : 0; };
    for (const auto& [id, viewer] : viewers_) {
        for (const SharedBytes& note : viewer.notes) add(note);
        for (const SharedBytes& note : viewer.frame_notes) add(note);
        for (const ViewerStream& stream : viewer.streams) add(stream.waiting);
    }
    return bytes;
}

// Acts on the state: encodes pictures for viewers who have room, and writes to each viewer that is idle.
Viewers::Actions Viewers::settle(Nanoseconds now) {
    Actions actions;
    if (viewers_.empty()) return actions;
    rested_ = rested_ || at_rest(now);
    const ViewFormat format = at_rest(now) ? ViewFormat::kPng : ViewFormat::kJpeg;
    for (std::uint32_t s = 0; s < kMaxStreams; ++s) {
        Stream& stream = streams_[s];
        if (!stream.frame) continue;
        const PictureKey key{run_, *stream.frame, s, format};
        const SharedBytes& encoded = stream.encoded[index(format)];
        auto& encoding = stream.encoding[index(format)];
        for (auto& [id, viewer] : viewers_) {
            if (!wants(viewer, key)) continue;
            if (encoded) {
                give(viewer, key, encoded);
            } else if (!encoding) {
                encoding = key;
                actions.emplace_back(EncodePicture{key, stream.picture, stream.plan});
            }
        }
    }
    for (auto& [id, viewer] : viewers_) {
        if (viewer.writing != Writing::kNothing || send_text(id, viewer, actions)) continue;
        if (viewer.picture_last)
            send_frame_note(id, viewer, actions) || send_picture(id, viewer, actions);
        else
            send_picture(id, viewer, actions) || send_frame_note(id, viewer, actions);
    }
    return actions;
}

// True if the viewer has room for the picture. A viewer to whom another is being written has none; the newest
// picture is chosen when that is done.
bool Viewers::wants(const Viewer& viewer, const PictureKey& key) {
    const ViewerStream& stream = viewer.streams[key.stream];
    return viewer.writing != Writing::kPicture && stream.unshown.size() < kMaxUnshown &&
           (!stream.given || *stream.given < key);
}

// Replaces the waiting picture. A null message passes over a picture that could not be encoded.
void Viewers::give(Viewer& viewer, const PictureKey& key, const SharedBytes& message) {
    ViewerStream& stream = viewer.streams[key.stream];
    stream.given = key;
    stream.waiting = message;
}

bool Viewers::send_text(ViewerId id, Viewer& viewer, Actions& actions) const {
    if (std::exchange(viewer.audience, false)) {
        viewer.writing = Writing::kText;
        actions.emplace_back(SendAudience{id, lead_, count(), session_});
        return true;
    }
    for (const NoteTopic topic : kNewestOnly) {
        SharedBytes note = std::exchange(viewer.notes[index(topic)], nullptr);
        if (!note) continue;
        viewer.writing = Writing::kText;
        actions.emplace_back(SendBytes{id, std::move(note), true});
        return true;
    }
    return false;
}

bool Viewers::send_frame_note(ViewerId id, Viewer& viewer, Actions& actions) {
    if (viewer.frame_notes.empty()) return false;
    viewer.writing = Writing::kText;
    viewer.picture_last = false;
    actions.emplace_back(SendBytes{id, std::move(viewer.frame_notes.front()), true});
    viewer.frame_notes.pop_front();
    return true;
}

bool Viewers::send_picture(ViewerId id, Viewer& viewer, Actions& actions) {
    for (std::uint32_t i = 0; i < kMaxStreams; ++i) {
        const std::uint32_t s = (viewer.next_stream + i) % kMaxStreams;
        ViewerStream& stream = viewer.streams[s];
        if (!stream.waiting) continue;
        viewer.writing = Writing::kPicture;
        viewer.picture_last = true;
        viewer.next_stream = (s + 1) % kMaxStreams;
        stream.unshown.push_back(*stream.given);
        actions.emplace_back(SendBytes{id, std::exchange(stream.waiting, nullptr), false});
        return true;
    }
    return false;
}

void Viewers::tell_audience() {
    for (auto& [id, viewer] : viewers_) viewer.audience = true;
}

}  // namespace swath

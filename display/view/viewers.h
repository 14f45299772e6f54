#pragma once
#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <variant>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/clock.h"
#include "common/base/ids.h"
#include "common/image/picture.h"
#include "common/wire/messages.h"

namespace swath {

// A viewer's number, from 1 in order of arrival; 0 is nobody.
using ViewerId = std::uint32_t;

// Bytes for several viewers: a note's text, or a picture's message.
using SharedBytes = std::shared_ptr<const Buffer>;

// Formats of pictures, the better one last.
enum class ViewFormat : std::uint32_t { kJpeg, kPng };
template <>
inline constexpr auto kNames<ViewFormat> = names_of<ViewFormat>("format", {{ViewFormat::kJpeg, "jpeg"},
                                                                           {ViewFormat::kPng, "png"}});

// A picture in a format. Within a stream the newer or better one is larger.
struct PictureKey {
    std::uint64_t run = 0;  // counts sessions, since frame numbers begin anew with each
    FrameNumber frame = 0;
    std::uint32_t stream = 0;  // below kMaxStreams
    ViewFormat format = ViewFormat::kJpeg;
    bool operator==(const PictureKey&) const = default;
    bool operator<(const PictureKey& other) const {
        return std::tie(run, frame, stream, format) <
               std::tie(other.run, other.frame, other.stream, other.format);
    }
};

// Orders from Viewers.
struct EncodePicture {  // answered by on_encoded
    PictureKey key;
    std::shared_ptr<const Picture> picture;
    SharedBytes plan;  // for the message's header; null: none
};
struct SendBytes {  // answered by on_written
    ViewerId to = 0;
    SharedBytes bytes;
    bool text = false;  // a note, not a picture
};
struct SendAudience {  // tells who looks and leads; answered by on_written
    ViewerId to = 0;
    ViewerId lead = 0;
    std::uint32_t viewers = 0;
    bool session = false;
    bool operator==(const SendAudience&) const = default;
};
using ViewerAction = std::variant<EncodePicture, SendBytes, SendAudience>;

// Decides what viewers get: who leads, which picture is encoded in which format, and what is written to whom
// next. The newest wins everywhere: a viewer gets one message at a time, and the next is chosen when that one
// is written. So a slow viewer misses what it has no room for, and nothing piles up. Sans-I/O like Assembly:
// it never looks into pictures and bytes. Times come from one clock that does not go back. Not thread-safe.
class Viewers {
  public:
    // A picture without a successor for this long is sent as PNG.
    static constexpr Nanoseconds kRest = std::chrono::milliseconds(150);
    // At most so many pictures of a stream are sent to a viewer that has not shown them.
    static constexpr std::size_t kMaxUnshown = 2;
    // At most so many `frame` notes wait for a viewer; then the oldest goes.
    static constexpr std::size_t kMaxFrameNotes = 64;
    // At most so many plans wait for their pictures, likewise.
    static constexpr std::size_t kMaxPlans = kMaxFramesInFlight + 4;

    using Actions = std::vector<ViewerAction>;

    // Ids ascend from call to call. The first viewer leads; when the leader leaves, the viewer who has been
    // there longest does.
    Actions on_join(ViewerId viewer, Nanoseconds now);
    Actions on_leave(ViewerId viewer, Nanoseconds now);
    Actions on_lead(ViewerId viewer, Nanoseconds now);
    // The last message to the viewer is written: it can take another.
    Actions on_written(ViewerId viewer, Nanoseconds now);
    // The viewer shows this picture of this run, and is done with those sent before it.
    Actions on_shown(ViewerId viewer, const PictureKey& shown, Nanoseconds now);

    // Begins a session; a `live` one takes wishes. The session before must be over.
    Actions on_session(bool live, Nanoseconds now);
    Actions on_session_end(Nanoseconds now);
    Actions on_note(NoteTopic topic, FrameNumber frame, SharedBytes text, Nanoseconds now);
    // A frame is in the making: the complete picture will have a successor.
    void on_announced(FrameNumber frame);
    Actions on_picture(FrameNumber frame, std::uint32_t stream, std::shared_ptr<const Picture> picture,
                       Nanoseconds now);
    // `message` is the picture with its header; null if it cannot be encoded.
    Actions on_encoded(const PictureKey& key, SharedBytes message, Nanoseconds now);

    // The time of the next on_tick, unless another event comes before.
    std::optional<Nanoseconds> deadline() const;
    Actions on_tick(Nanoseconds now) { return settle(now); }

    std::uint32_t count() const { return static_cast<std::uint32_t>(viewers_.size()); }
    std::uint64_t run() const { return run_; }
    // True if this viewer's wishes count.
    bool steers(ViewerId viewer) const { return live_ && viewer == lead_; }
    // Bytes that wait for viewers, without messages that are being written. Shared bytes count for each
    // viewer.
    std::size_t waiting_bytes() const;

  private:
    enum class Writing { kNothing, kText, kPicture };
    struct ViewerStream {
        std::optional<PictureKey> given;  // the newest that was sent or waits
        SharedBytes waiting;              // the message of `given`, until it is sent
        std::deque<PictureKey> unshown;   // sent, ascending
    };
    struct Viewer {
        Writing writing = Writing::kNothing;
        bool audience = true;                                       // it must still be told who looks
        std::array<SharedBytes, kAll<NoteTopic>.size() + 1> notes;  // by topic; null: nothing new
        std::deque<SharedBytes> frame_notes;
        std::array<ViewerStream, kMaxStreams> streams;
        bool picture_last = false;      // pictures and `frame` notes take turns
        std::uint32_t next_stream = 0;  // streams take turns, too
    };
    struct Stream {
        std::optional<FrameNumber> frame;  // of the newest picture
        std::shared_ptr<const Picture> picture;
        SharedBytes plan;
        std::array<SharedBytes, kAll<ViewFormat>.size()> encoded;
        std::array<std::optional<PictureKey>, kAll<ViewFormat>.size()> encoding;  // under way
    };

    Actions settle(Nanoseconds now);
    bool at_rest(Nanoseconds now) const { return announced_.empty() && now >= completed_ + kRest; }
    static bool wants(const Viewer& viewer, const PictureKey& key);
    static void give(Viewer& viewer, const PictureKey& key, const SharedBytes& message);
    bool send_text(ViewerId id, Viewer& viewer, Actions& actions) const;
    static bool send_frame_note(ViewerId id, Viewer& viewer, Actions& actions);
    static bool send_picture(ViewerId id, Viewer& viewer, Actions& actions);
    void tell_audience();

    std::map<ViewerId, Viewer> viewers_;  // in order of arrival
    ViewerId lead_ = 0;

    std::uint64_t run_ = 0;
    bool session_ = false;
    bool live_ = false;
    std::array<SharedBytes, kAll<NoteTopic>.size() + 1> sticky_;  // the newest by topic, for newcomers
    std::map<FrameNumber, SharedBytes> plans_;
    std::set<FrameNumber> announced_;  // those that are not complete
    std::array<Stream, kMaxStreams> streams_;
    Nanoseconds completed_{0};  // time of the newest picture
    bool rested_ = true;        // it has come to rest since, which was acted on
};

}  // namespace swath

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

// A viewer's number, from 1 in the order in which they came; 0 is nobody.
using ViewerId = std::uint32_t;

// Bytes that several viewers get: a note's text, or a picture's message.
using SharedBytes = std::shared_ptr<const Buffer>;

// How a picture is coded, the better one last.
enum class ViewFormat : std::uint32_t { kJpeg, kPng };
inline constexpr std::size_t kViewFormats = 2;

// A picture in a format. Within a stream what is newer or better is larger.
struct PictureKey {
    std::uint64_t run = 0;  // counts sessions: frame numbers begin anew with each
    FrameNumber frame = 0;
    std::uint32_t stream = 0;  // below kMaxStreams
    ViewFormat format = ViewFormat::kJpeg;
    bool operator==(const PictureKey&) const = default;
    bool operator<(const PictureKey& other) const {
        return std::tie(run, frame, stream, format) <
               std::tie(other.run, other.frame, other.stream, other.format);
    }
};

// What Viewers wants done.
struct EncodePicture {  // then on_encoded
    PictureKey key;
    std::shared_ptr<const Picture> picture;
    SharedBytes plan;  // for the message's header; null if there is none
};
struct SendBytes {  // then on_written
    ViewerId to = 0;
    SharedBytes bytes;
    bool text = false;  // a note, not a picture
};
struct SendAudience {  // who looks, now; then on_written
    ViewerId to = 0;
    ViewerId lead = 0;
    std::uint32_t viewers = 0;
    bool session = false;
    bool operator==(const SendAudience&) const = default;
};
using ViewerAction = std::variant<EncodePicture, SendBytes, SendAudience>;

// Decides what the people who look at a run get: who leads, which picture is coded in which format, and what
// is written to whom next. Newest wins everywhere: a viewer is handed one message at a time and the next is
// chosen when that one is written, so that a slow one misses what it has no room for and nothing piles up.
// Sans-I/O like Assembly: it never looks into pictures and bytes. Times are of any one clock and do not go
// back. Not thread-safe.
class Viewers {
  public:
    // A picture without a successor for this long is sent without loss.
    static constexpr Nanoseconds kRest = std::chrono::milliseconds(150);
    // Pictures of a stream that a viewer has been sent and has not shown yet, at most.
    static constexpr std::size_t kMaxUnshown = 2;
    // Of `frame` notes that wait for a viewer the oldest go when there are more.
    static constexpr std::size_t kMaxFrameNotes = 64;
    // Likewise of plans that wait for their pictures.
    static constexpr std::size_t kMaxPlans = kMaxFramesInFlight + 4;

    using Actions = std::vector<ViewerAction>;

    // Ids ascend from call to call. The first one leads; when the leader goes, the one who has been there
    // longest does.
    Actions on_join(ViewerId viewer, Nanoseconds now);
    Actions on_leave(ViewerId viewer, Nanoseconds now);
    Actions on_lead(ViewerId viewer, Nanoseconds now);
    // The last message handed out to the viewer is written: it can take another.
    Actions on_written(ViewerId viewer, Nanoseconds now);
    // The viewer has that picture of this run on its screen, and is through with those sent before it.
    Actions on_shown(ViewerId viewer, const PictureKey& shown, Nanoseconds now);

    // A session begins. With `live` it takes wishes. A session must be over before the next begins.
    Actions on_session(bool live, Nanoseconds now);
    Actions on_session_end(Nanoseconds now);
    Actions on_note(NoteTopic topic, FrameNumber frame, SharedBytes text, Nanoseconds now);
    // A frame is being made: what is complete will have a successor.
    void on_announced(FrameNumber frame);
    Actions on_picture(FrameNumber frame, std::uint32_t stream, std::shared_ptr<const Picture> picture,
                       Nanoseconds now);
    // `message` is the picture with its header, null if it cannot be coded.
    Actions on_encoded(const PictureKey& key, SharedBytes message, Nanoseconds now);

    // When on_tick is due, unless another event comes before.
    std::optional<Nanoseconds> deadline() const;
    Actions on_tick(Nanoseconds now) { return settle(now); }

    std::uint32_t count() const { return static_cast<std::uint32_t>(viewers_.size()); }
    std::uint64_t run() const { return run_; }
    // Whether this viewer's wishes count.
    bool steers(ViewerId viewer) const { return live_ && viewer == lead_; }
    // What waits for viewers, without the messages that are being written; what they share counts for each.
    std::size_t waiting_bytes() const;

  private:
    enum class Writing { kNothing, kText, kPicture };
    struct ViewerStream {
        std::optional<PictureKey> given;  // the newest that was sent or waits
        SharedBytes waiting;              // its message, until it is sent
        std::deque<PictureKey> unshown;   // sent, ascending
    };
    struct Viewer {
        Writing writing = Writing::kNothing;
        bool audience = true;                                // it has yet to hear who looks
        std::array<SharedBytes, kNoteTopicCount + 1> notes;  // by topic; null: nothing new
        std::deque<SharedBytes> frame_notes;
        std::array<ViewerStream, kMaxStreams> streams;
        bool picture_last = false;      // pictures and `frame` notes take turns
        std::uint32_t next_stream = 0;  // streams do too
    };
    struct Stream {
        std::optional<FrameNumber> frame;  // of the newest picture
        std::shared_ptr<const Picture> picture;
        SharedBytes plan;
        std::array<SharedBytes, kViewFormats> encoded;
        std::array<std::optional<PictureKey>, kViewFormats> encoding;  // is being made
    };

    Actions settle(Nanoseconds now);
    bool at_rest(Nanoseconds now) const { return announced_.empty() && now >= completed_ + kRest; }
    static bool wants(const Viewer& viewer, const PictureKey& key);
    static void give(Viewer& viewer, const PictureKey& key, const SharedBytes& message);
    bool send_text(ViewerId id, Viewer& viewer, Actions& actions) const;
    static bool send_frame_note(ViewerId id, Viewer& viewer, Actions& actions);
    static bool send_picture(ViewerId id, Viewer& viewer, Actions& actions);
    void tell_audience();

    std::map<ViewerId, Viewer> viewers_;  // in the order in which they came
    ViewerId lead_ = 0;

    std::uint64_t run_ = 0;
    bool session_ = false;
    bool live_ = false;
    std::array<SharedBytes, kNoteTopicCount + 1> sticky_;  // the newest by topic, for newcomers
    std::map<FrameNumber, SharedBytes> plans_;
    std::set<FrameNumber> announced_;  // and not complete
    std::array<Stream, kMaxStreams> streams_;
    Nanoseconds completed_{0};  // when the newest picture was
    bool rested_ = true;        // since then it has come to rest, and that was acted on
};

}  // namespace swath

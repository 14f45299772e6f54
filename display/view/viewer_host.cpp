#include "display/view/viewer_host.h"

#include <fmt/core.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "common/base/log.h"

namespace swath {
namespace asio = boost::asio;
namespace {

SharedBytes to_bytes(std::string_view text) {
    auto bytes = std::make_shared<Buffer>();
    bytes->append(text.data(), text.size());
    return bytes;
}

// Encodes a picture into a message (docs/viewer.md, WebSocket).
SharedBytes picture_message(const EncodePicture& task) {
    const Buffer image = encode(
        *task.picture, task.key.format == ViewFormat::kPng ? PictureFormat::kPng : PictureFormat::kJpeg);
    const std::string head = fmt::format(
        R"({{"frame":{},"stream":{},"format":"{}","width":{},"height":{},"plan":)", task.key.frame,
        task.key.stream, name_of(task.key.format), task.picture->width, task.picture->height);
    const std::span<const std::uint8_t> plan =
        task.plan ? task.plan->bytes() : std::span<const std::uint8_t>();
    const std::string_view plan_text =
        task.plan ? std::string_view(reinterpret_cast<const char*>(plan.data()), plan.size()) : "null";
    const std::size_t head_bytes = head.size() + plan_text.size() + 1;
    auto message = std::make_shared<Buffer>();
    message->resize(4 + head_bytes + image.size());  // allocates once
    message->resize(0);
    const std::uint8_t prefix[] = {
        static_cast<std::uint8_t>(head_bytes), static_cast<std::uint8_t>(head_bytes >> 8),
        static_cast<std::uint8_t>(head_bytes >> 16), static_cast<std::uint8_t>(head_bytes >> 24)};
    message->append(prefix, sizeof prefix);
    message->append(head.data(), head.size());
    message->append(plan_text.data(), plan_text.size());
    message->append("}", 1);
    message->append(image.data(), image.size());
    return message;
}

// The messages of a viewer, as far as the display reads them.
struct Lead {};
struct Wanted {};  // a wish, of which only the text counts
using ViewerText = std::variant<PictureKey, Lead, Wanted>;

Result<ViewerText> parse_text(std::string_view text) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return fail("not a JSON object");
    const auto string_at = [&](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const std::string type = string_at("type");
    if (type == "wish") return Wanted{};
    if (type == "lead") return Lead{};
    if (type != "shown") return fail("type: not one that is known");
    const auto number_below = [&](const char* key, std::uint64_t limit) -> std::optional<std::uint64_t> {
        const auto found = json.find(key);
        if (found == json.end() || !found->is_number_unsigned()) return std::nullopt;
        const auto value = found->get<std::uint64_t>();
        return value < limit ? std::optional(value) : std::nullopt;
    };
    const auto frame = number_below("frame", std::numeric_limits<std::uint64_t>::max());
    if (!frame) return fail("shown: frame: not a frame's number");
    const auto stream = number_below("stream", kMaxStreams);
    if (!stream) return fail("shown: stream: not a number below {}", kMaxStreams);
    const auto format = parse<ViewFormat>(string_at("format"));
    if (!format) return fail("shown: format: neither jpeg nor png");
    return PictureKey{0, *frame, static_cast<std::uint32_t>(*stream), *format};
}

}  // namespace

// Brings events to the session's executor. If the session is slow, it gets the newest of each kind.
class ViewerHost::Messenger : public std::enable_shared_from_this<Messenger> {
  public:
    Messenger(asio::any_io_executor executor, Callbacks callbacks)
        : executor_(std::move(executor)), callbacks_(std::move(callbacks)) {}

    void audience(std::uint32_t viewers) {
        const std::lock_guard lock(mutex_);
        audience_ = viewers;
        go();
    }
    void wish(ViewerId viewer, std::string_view text) {
        const std::lock_guard lock(mutex_);
        wish_.emplace(viewer, text);
        go();
    }

  private:
    void go() {
        if (std::exchange(on_its_way_, true)) return;
        asio::post(executor_, [self = shared_from_this()] { self->arrive(); });
    }
    void arrive() {
        std::unique_lock lock(mutex_);
        on_its_way_ = false;
        const auto audience = std::exchange(audience_, std::nullopt);
        const auto wish = std::exchange(wish_, std::nullopt);
        lock.unlock();
        if (audience) callbacks_.on_audience(*audience);
        if (wish) callbacks_.on_wish(wish->first, wish->second);
    }

    const asio::any_io_executor executor_;
    const Callbacks callbacks_;
    std::mutex mutex_;
    bool on_its_way_ = false;                               // mutex_ guards this
    std::optional<std::uint32_t> audience_;                 // and this
    std::optional<std::pair<ViewerId, std::string>> wish_;  // and this
};

Result<std::unique_ptr<ViewerHost>> ViewerHost::make(const WebServer::Options& options, const Clock& clock) {
    std::unique_ptr<ViewerHost> host(new ViewerHost(clock));
    WebServer::Handlers handlers;
    // Calls `on` with the lock held, on the web server's thread.
    const auto event = [raw = host.get()](auto on) {
        return [raw, on](ViewerId viewer) {
            const std::lock_guard lock(raw->mutex_);
            raw->perform((raw->viewers_.*on)(viewer, raw->clock_.now()));
        };
    };
    handlers.on_join = event(&Viewers::on_join);
    handlers.on_written = event(&Viewers::on_written);
    handlers.on_leave = event(&Viewers::on_leave);
    handlers.on_text = [raw = host.get()](ViewerId viewer, std::string_view text) {
        return raw->on_text(viewer, text);
    };
    SWATH_TRY(host->web_, WebServer::make(host->io_, options, std::move(handlers)));
    for (auto& encoder : host->encoders_) encoder = std::make_unique<WorkerThread>();
    host->thread_ = std::thread([raw = host.get()] { raw->serve(); });
    return host;
}

ViewerHost::ViewerHost(const Clock& clock) : clock_(clock) {}

ViewerHost::~ViewerHost() {
    io_.stop();
    if (thread_.joinable()) thread_.join();
}

void ViewerHost::serve() {
    const auto work = asio::make_work_guard(io_);
    while (!io_.stopped()) {
        try {
            io_.run();
        } catch (const std::exception& failure) {  // out of memory; the rest goes on
            log_warning("viewers: {}", failure.what());
        }
    }
}

ViewerHost::Numbers ViewerHost::numbers() const {
    const std::lock_guard lock(mutex_);
    return {viewers_.count(), encoded_, viewers_.waiting_bytes()};
}

std::uint32_t ViewerHost::begin(bool live, asio::any_io_executor executor, Callbacks callbacks) {
    const std::lock_guard lock(mutex_);
    messenger_ = std::make_shared<Messenger>(std::move(executor), std::move(callbacks));
    told_viewers_ = viewers_.count();
    perform(viewers_.on_session(live, clock_.now()));
    return told_viewers_;
}

void ViewerHost::end() {
    const std::lock_guard lock(mutex_);
    messenger_.reset();
    perform(viewers_.on_session_end(clock_.now()));
}

void ViewerHost::announce(FrameNumber frame) {
    const std::lock_guard lock(mutex_);
    viewers_.on_announced(frame);
}

void ViewerHost::picture(FrameNumber frame, std::uint32_t stream, std::shared_ptr<const Picture> picture) {
    const std::lock_guard lock(mutex_);
    perform(viewers_.on_picture(frame, stream, std::move(picture), clock_.now()));
}

Status ViewerHost::note(NoteTopic topic, FrameNumber frame, Buffer text) {
    if (text.size() > kMaxNoteBytes)
        return fail("Note: {} bytes, the limit is {}", text.size(), kMaxNoteBytes);
    // The text becomes a WebSocket's message or part of a picture's header. Viewers would break on bad JSON.
    const auto* const begin = reinterpret_cast<const char*>(text.data());
    if (text.empty() || *begin != '{' || !nlohmann::json::accept(begin, begin + text.size()))
        return fail("Note: not a JSON object");
    auto bytes = std::make_shared<const Buffer>(std::move(text));
    const std::lock_guard lock(mutex_);
    perform(viewers_.on_note(topic, frame, std::move(bytes), clock_.now()));
    return {};
}

Status ViewerHost::on_text(ViewerId viewer, std::string_view text) {
    SWATH_TRY(const auto parsed, parse_text(text));
    const std::lock_guard lock(mutex_);
    if (const auto* shown = std::get_if<PictureKey>(&parsed)) {
        PictureKey key = *shown;
        key.run = viewers_.run();
        perform(viewers_.on_shown(viewer, key, clock_.now()));
    } else if (std::holds_alternative<Lead>(parsed)) {
        perform(viewers_.on_lead(viewer, clock_.now()));
    } else if (viewers_.steers(viewer) && messenger_) {
        messenger_->wish(viewer, text);
    }
    return {};
}

void ViewerHost::perform(Viewers::Actions&& actions) {
    for (ViewerAction& action : actions) {
        if (auto* task = std::get_if<EncodePicture>(&action)) {
            encode_on_its_thread(std::move(*task));
        } else if (auto* bytes = std::get_if<SendBytes>(&action)) {
            send(bytes->to, std::move(bytes->bytes), bytes->text);
        } else {
            const auto& audience = std::get<SendAudience>(action);
            send(audience.to,
                 to_bytes(fmt::format(R"({{"type":"audience","you":{},"lead":{},"viewers":{},"session":{}}})",
                                      audience.to, audience.lead, audience.viewers, audience.session)),
                 true);
        }
    }
    if (messenger_ && viewers_.count() != told_viewers_) {
        told_viewers_ = viewers_.count();
        messenger_->audience(told_viewers_);
    }
    if (!timer_armed_ && viewers_.deadline()) {
        timer_armed_ = true;
        asio::post(io_, [this] { wait_for_deadline(); });
    }
}

void ViewerHost::send(ViewerId to, SharedBytes bytes, bool text) {
    asio::post(io_, [this, to, bytes = std::move(bytes), text] { web_->send(to, bytes, text); });
}

void ViewerHost::encode_on_its_thread(EncodePicture&& task) {
    WorkerThread& encoder = *encoders_[static_cast<std::size_t>(task.key.format)];
    encoder.post([this, task = std::move(task)]() mutable {
        try {
            const SharedBytes message = picture_message(task);
            task.picture.reset();
            const std::lock_guard lock(mutex_);
            ++encoded_;
            perform(viewers_.on_encoded(task.key, message, clock_.now()));
        } catch (const std::exception& failure) {  // out of memory
            log_warning("a picture for viewers: {}; passed over", failure.what());
            const std::lock_guard lock(mutex_);
            perform(viewers_.on_encoded(task.key, nullptr, clock_.now()));
        }
    });
}

// Events move the deadline on without touching the timer, which runs to its end and looks again.
void ViewerHost::wait_for_deadline() {
    const std::lock_guard lock(mutex_);
    const auto deadline = viewers_.deadline();
    const Nanoseconds now = clock_.now();
    if (deadline && *deadline > now) {
        timer_.expires_after(*deadline - now);
        timer_.async_wait([this](const boost::system::error_code& stopped) {
            if (!stopped) wait_for_deadline();
        });
        return;
    }
    timer_armed_ = false;
    perform(viewers_.on_tick(now));
}

}  // namespace swath

#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "tests/bench/figures.h"
#include "tests/support/models.h"
#include "tests/support/process.h"
#include "tests/support/web_client.h"

namespace swath::bench {
namespace {

using nlohmann::json;
using Steady = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::chrono::seconds kViewerPatience(120);
constexpr const char* kSize = "1280x960";
constexpr std::chrono::microseconds kAnimationFrame(16'667);  // a page sends at most one wish in this time
constexpr double kInputLagBeyond = 30;                        // ms

// A message to a page: a note, or a picture with its header.
struct Heard {
    Steady::time_point at;
    json value;
    bool picture = false;
};

// A page without a screen: it answers pictures as they come.
class Page {
  public:
    // `line` is printed by the program: "viewer http://127.0.0.1:8080/".
    static Result<std::unique_ptr<Page>> open(const std::string& line) {
        static constexpr std::string_view kScheme = "http://";
        const auto begin = line.find(kScheme) + kScheme.size();
        SWATH_TRY(const auto address, parse_address(line.substr(begin, line.find('/', begin) - begin)));
        SWATH_TRY(auto client, test::WebClient::connect(address));
        return std::unique_ptr<Page>(new Page(std::move(client)));
    }

    // The next message; nothing if none came in time.
    std::optional<Heard> hear(std::chrono::milliseconds limit) {
        const auto message = client_->next(limit);
        if (!message) return std::nullopt;
        Heard heard{Steady::now(), {}, !message->text};
        std::string_view text = message->bytes;
        if (heard.picture) {
            std::uint32_t size = 0;
            std::memcpy(&size, text.data(), std::min(sizeof size, text.size()));
            text = text.substr(std::min(sizeof size, text.size()), size);
        }
        heard.value = json::parse(text, nullptr, false);
        if (heard.picture)
            say({{"type", "shown"},
                 {"frame", heard.value.at("frame")},
                 {"stream", heard.value.at("stream")},
                 {"format", heard.value.at("format")}});
        return heard;
    }
    void say(const json& message) { client_->send(message.dump()); }
    bool connected() const { return !client_->close_code(); }

  private:
    explicit Page(std::unique_ptr<test::WebClient> client) : client_(std::move(client)) {}
    std::unique_ptr<test::WebClient> client_;
};

// Takes all pictures of a display on a thread of its own, until the end of the object.
class Audience {
  public:
    explicit Audience(std::unique_ptr<Page> page) : page_(std::move(page)) {
        thread_ = std::thread([this] {
            while (!over_ && page_->connected())
                if (const auto heard = page_->hear(std::chrono::milliseconds(50)); heard && heard->picture)
                    ++pictures_;
        });
    }
    ~Audience() {
        over_ = true;
        thread_.join();
    }
    Audience(const Audience&) = delete;
    Audience& operator=(const Audience&) = delete;
    std::size_t pictures() const { return pictures_; }

  private:
    std::unique_ptr<Page> page_;
    std::atomic<bool> over_ = false;
    std::atomic<std::size_t> pictures_ = 0;
    std::thread thread_;
};

// Starts the programs beside this one, with a cache of their own.
class Programs {
  public:
    std::unique_ptr<test::Process> start(const std::string& program,
                                         const std::vector<std::string>& arguments) const {
        return std::make_unique<test::Process>(
            std::filesystem::path(client_program()).replace_filename(program), arguments,
            test::Process::Options{{"LP_NUM_THREADS=0", "XDG_CACHE_HOME=" + files_.path_of("cache")}, {}});
    }

  private:
    test::TemporaryFolder files_;
};

std::string address_of(test::Process& process) {
    static constexpr std::string_view kAnnouncement = "listening ";
    return process.wait_for_line("listening 127.0.0.1:", kViewerPatience).substr(kAnnouncement.size());
}

// CPU time of a running program, all threads.
double cpu_s(const test::Process& process) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(process.pid(), &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// CPU time of all children that have been waited for.
double ended_cpu_s() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Runs along a path in three ways, in turn: with a display without a page, with a page that nobody looks at,
// and with a viewer who takes all pictures.
Status bench_cost(Figures& figures, const Effort& effort, const Programs& programs) {
    const std::vector<std::string> listen{"--listen", "127.0.0.1:0"};
    std::vector<std::unique_ptr<test::Process>> servers;
    std::vector<std::string> addresses;
    for (int i = 0; i < 2; ++i) {
        servers.push_back(programs.start("swath-server", listen));
        addresses.push_back(address_of(*servers.back()));
    }
    const auto plain = programs.start("swath-display", listen);
    const auto viewed = programs.start("swath-display", {"--listen", "127.0.0.1:0", "--view", "127.0.0.1:0"});
    const std::string plain_address = address_of(*plain);
    const std::string viewed_address = address_of(*viewed);
    const std::string page_line = viewed->wait_for_line("viewer http://", kViewerPatience);

    const auto all_cpu_s = [&] {
        double sum = ended_cpu_s() + cpu_s(*plain) + cpu_s(*viewed);
        for (const auto& server : servers) sum += cpu_s(*server);
        return sum;
    };
    const auto frames_per_s = [&](const std::string& display) -> Result<double> {
        const auto client = programs.start(
            "swath-client",
            {effort.model, "--quiet", "--size", kSize, "--frames", std::to_string(effort.frames), "--servers",
             fmt::format("{}", fmt::join(addresses, ",")), "--display", display});
        const test::Finished run = client->wait(kViewerPatience);
        if (run.exit_code != 0)
            return fail("swath-client failed with exit code {}: {}", run.exit_code, run.err);
        Finished finished;
        finished.output = run.out;
        return finished.frames_per_s();
    };
    std::vector<double> cost;
    std::vector<double> idle_cost;
    std::vector<double> cpu_cost;
    std::size_t pictures = 0;
    // The first round fills caches.
    for (int round = 0; round <= effort.repetitions; ++round) {
        std::map<std::string, double> fps;
        std::map<std::string, double> cpu;
        // Each way comes first, second and last in turn.
        std::array<std::string, 3> ways{"plain", "idle", "watched"};
        std::rotate(ways.begin(), ways.begin() + round % 3, ways.end());
        for (const std::string& way : ways) {
            std::optional<Audience> audience;
            if (way == "watched") {
                SWATH_TRY(auto page, Page::open(page_line));
                audience.emplace(std::move(page));
            }
            const double before_s = all_cpu_s();
            SWATH_TRY(const auto measured, frames_per_s(way == "plain" ? plain_address : viewed_address));
            fps[way] = measured;
            cpu[way] = all_cpu_s() - before_s;
            if (audience) pictures += audience->pictures();
        }
        if (round == 0 && !effort.smoke) continue;
        cost.push_back(fps["watched"] / fps["plain"]);
        idle_cost.push_back(fps["idle"] / fps["plain"]);
        cpu_cost.push_back(cpu["watched"] / cpu["plain"]);
    }
    if (pictures == 0) return fail("a run was watched and no picture came");
    figures.add(
        "viewer_cost", cost, "ratio",
        fmt::format("at least 0.95: frames/s at {} with one viewer over those without a page", kSize));
    figures.add("viewer_cpu", cpu_cost, "ratio",
                "no bar; CPU time of all programs but the viewer, with one over without");
    figures.add("viewer_idle_cost", idle_cost, "ratio",
                "1 within the noise: ... with a page that nobody looks at over those without");
    return {};
}

// Measures the time from a wish to the picture made from it, and the pipeline's own part of that.
class Lag {
  public:
    void sent(std::uint64_t wish, Steady::time_point at) { sent_[wish] = at; }

    void hear(const Heard& heard) {
        const json& value = heard.value;
        if (heard.picture && value.at("plan").is_object()) {
            const auto frame = value.at("frame").get<std::uint64_t>();
            const auto found = sent_.find(value.at("plan").at("wish").get<std::uint64_t>());
            // Only a wish's first picture counts; its lossless one comes after a rest.
            if (found == sent_.end()) return;
            ++pictures_;
            picture_ms_[frame] = Milliseconds(heard.at - found->second).count();
            sent_.erase(sent_.begin(), std::next(found));
        } else if (!heard.picture && value.value("type", "") == "frame") {
            if (value.at("interval").is_number()) frame_ms_.push_back(value.at("interval"));
            pipeline_ms_[value.at("frame").get<std::uint64_t>()] = pipeline_ms(value.at("machines"));
        }
    }

    std::size_t pictures() const { return pictures_; }
    const std::vector<double>& frame_ms() const { return frame_ms_; }
    // The time besides the pipeline's, of every frame of which both are known.
    std::vector<double> beyond_ms() const {
        std::vector<double> beyond;
        for (const auto& [frame, ms] : picture_ms_)
            if (const auto found = pipeline_ms_.find(frame); found != pipeline_ms_.end())
                beyond.push_back(ms - found->second);
        return beyond;
    }

  private:
    // From the beginning of the frame at the client to the complete picture at the display.
    static double pipeline_ms(const json& machines) {
        double begin = 0;
        double end = 0;
        for (const json& machine : machines)
            for (const json& span : machine.at("spans")) {
                if (machine.at("name") == "client" && span.at(0) == "partition") begin = span.at(1);
                if (machine.at("name") == "display" && span.at(0) == "assemble")
                    end = std::max(end, span.at(2).get<double>());
            }
        return end - begin;
    }

    std::map<std::uint64_t, Steady::time_point> sent_;  // wishes without a picture yet
    std::map<std::uint64_t, double> picture_ms_;        // by frame
    std::map<std::uint64_t, double> pipeline_ms_;       // by frame
    std::vector<double> frame_ms_;
    std::size_t pictures_ = 0;
};

// Steers as a viewer who turns the model all the time, with a new wish every animation frame.
Status bench_steering(Figures& figures, const Effort& effort, const Programs& programs) {
    const auto client = programs.start("swath-client", {"builtin:knot:20000", "--local", "2", "--view", "0"});
    SWATH_TRY(auto page, Page::open(client->wait_for_line("viewer http://", kViewerPatience)));
    json wish{{"type", "wish"}, {"id", 0}, {"width", 1280}, {"height", 960}};
    const auto begin = Steady::now();
    while (!wish.contains("camera")) {
        const auto heard = page->hear(kViewerPatience);
        if (!heard) return fail("no session came");
        if (!heard->picture && heard->value.value("type", "") == "session")
            wish["camera"] = heard->value.at("home");
        if (Steady::now() - begin > kViewerPatience) return fail("no session came");
    }
    const json home = wish["camera"];

    std::vector<double> fps;
    std::vector<double> lag_ms;
    std::vector<double> frame_ms;
    const auto length = effort.smoke ? std::chrono::milliseconds(500) : std::chrono::milliseconds(3000);
    std::uint64_t id = 0;
    // The first round warms up.
    for (int round = 0; round <= effort.repetitions; ++round) {
        Lag lag;
        const auto start = Steady::now();
        // A busy machine may need longer for its first picture.
        const auto goes_on = [&] {
            const auto passed = Steady::now() - start;
            return passed < length || (passed < kViewerPatience && lag.beyond_ms().empty());
        };
        for (auto next = start; goes_on();) {
            if (const auto now = Steady::now(); now >= next) {
                const double angle = 0.01 * static_cast<double>(++id);
                const double dx = home[0].get<double>() - home[3].get<double>();
                const double dz = home[2].get<double>() - home[5].get<double>();
                wish["id"] = id;
                wish["camera"][0] = home[3].get<double>() + dx * std::cos(angle) + dz * std::sin(angle);
                wish["camera"][2] = home[5].get<double>() + dz * std::cos(angle) - dx * std::sin(angle);
                lag.sent(id, now);
                page->say(wish);
                next = std::max(next + kAnimationFrame, now);
            }
            const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next - Steady::now());
            if (const auto heard = page->hear(std::max(wait, std::chrono::milliseconds(0)))) lag.hear(*heard);
        }
        const std::chrono::duration<double> passed = Steady::now() - start;
        if (!page->connected()) return fail("the display has closed the connection");
        if (round == 0 && !effort.smoke) continue;
        const auto beyond = lag.beyond_ms();
        if (beyond.empty()) return fail("no picture came of {} wishes", id);
        fps.push_back(static_cast<double>(lag.pictures()) / passed.count());
        lag_ms.push_back(median(beyond));
        frame_ms.push_back(median(lag.frame_ms()));
    }
    figures.add(
        "page_fps", fps, "1/s",
        fmt::format("at least 30: pictures a viewer gets at {} while it steers a small model", kSize));
    figures.add("page_frame_ms", frame_ms, "ms", "the time between two of those frames");
    figures.add(
        "input_lag_ms", lag_ms, "ms",
        fmt::format(
            "at most {:.0f}, that time and {:.0f}: from a wish to its picture, less the pipeline's own "
            "latency",
            median(frame_ms) + kInputLagBeyond, kInputLagBeyond));
    return {};
}

// The busy time of the busiest machine of a frame note, as in a prediction.
double busiest_ms(const json& note) {
    double most = 0;
    for (const json& machine : note.at("machines")) {
        double sum = 0;
        for (const json& span : machine.at("spans"))
            if (span.at(0) != "wait") sum += span.at(2).get<double>() - span.at(1).get<double>();
        most = std::max(most, sum);
    }
    return most;
}

// Compares predictions of all algorithms, at the rates that the hybrid has shown, with the time of their
// frames in the same round.
Status bench_prediction(Figures& figures, const Effort& effort, const Programs& programs) {
    const std::string model = effort.smoke ? "builtin:knot:20000" : "builtin:knot:200000";
    const auto client = programs.start("swath-client", {model, "--local", "2", "--view", "0"});
    SWATH_TRY(auto page, Page::open(client->wait_for_line("viewer http://", kViewerPatience)));
    const std::vector<std::string> algorithms{"hybrid", "mahd", "kd-split", "sort-last"};
    constexpr int kFrames = 24;
    constexpr int kPassedOver = 4;  // frames after a change, some of which are another algorithm's
    std::map<std::string, std::vector<double>> errors;
    std::uint64_t id = 0;
    // The first round teaches the rates.
    for (int round = 0; round <= effort.repetitions; ++round) {
        std::map<std::string, std::vector<double>> predicted_ms;
        std::map<std::string, std::vector<double>> measured_ms;
        for (const std::string& algorithm : algorithms) {
            page->say({{"type", "wish"},
                       {"id", ++id},
                       {"width", 1280},
                       {"height", 960},
                       {"path", "orbit"},
                       {"algorithm", algorithm}});
            for (int frames = 0; frames < kFrames + kPassedOver;) {
                const auto heard = page->hear(kViewerPatience);
                if (!heard) return fail("no more frames came");
                if (heard->picture || heard->value.value("type", "") != "frame" ||
                    heard->value.at("algorithm") != algorithm)
                    continue;
                if (++frames <= kPassedOver) continue;
                measured_ms[algorithm].push_back(busiest_ms(heard->value));
                if (algorithm == "hybrid" && heard->value.at("others").is_array())
                    for (const json& other : heard->value.at("others"))
                        predicted_ms[other.at("algorithm")].push_back(other.at("frame"));
            }
        }
        if (round == 0 && !effort.smoke) continue;
        for (const std::string& algorithm : algorithms)
            if (!predicted_ms[algorithm].empty())
                errors[algorithm].push_back(median(predicted_ms[algorithm]) / median(measured_ms[algorithm]));
    }
    for (const std::string& algorithm : algorithms)
        if (!errors[algorithm].empty())
            figures.add("predicted_" + algorithm, errors[algorithm], "ratio",
                        "no bar: its frame as predicted while the hybrid runs, over what it then takes");
    return {};
}

}  // namespace

Status bench_viewer(Figures& figures, const Effort& effort) {
    const Programs programs;
    try {
        SWATH_TRY_VOID(bench_cost(figures, effort, programs));
        SWATH_TRY_VOID(bench_steering(figures, effort, programs));
        return bench_prediction(figures, effort, programs);
    } catch (
        const std::exception& error) {  // a program ended or said nothing, a note is not what it should be
        return fail("{}", error.what());
    }
}

}  // namespace swath::bench

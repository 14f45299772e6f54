#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

#include "tests/bench/figures.h"
#include "tests/e2e/docker/engine.h"
#include "tests/support/web_client.h"

namespace swath::bench {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience(60);
constexpr std::chrono::milliseconds kBetweenTries(10);
constexpr int kServers = 4;  // compose.yaml's default

// The time of the first success.
Steady::time_point first_success(const std::function<bool()>& attempt) {
    const auto end = Steady::now() + kPatience;
    while (!attempt()) {
        if (Steady::now() > end) throw std::runtime_error("no picture within a minute");
        std::this_thread::sleep_for(kBetweenTries);
    }
    return Steady::now();
}

struct Start {
    double up_s = 0;       // until `up -d` returned, with containers and network made
    double page_s = 0;     // until the page was served
    double picture_s = 0;  // until a viewer had the first picture
};

Start cold_start(const test::Image& image, const std::string& model) {
    const test::Cluster cluster(image, {model, "1280x960"});
    const auto address = *parse_address(cluster.view());
    const auto begin = Steady::now();
    const auto since = [begin](Steady::time_point t) {
        return std::chrono::duration<double>(t - begin).count();
    };

    // Looks while compose is still at work, as a browser's reload would.
    Start start;
    std::exception_ptr failure;
    std::thread looking([&] {
        try {
            start.page_s = since(first_success([&] { return test::http_get(address, "/").status == 200; }));
            std::unique_ptr<test::WebClient> viewer;
            first_success([&] {
                auto opened = test::WebClient::connect(address);
                if (opened) viewer = std::move(*opened);
                return viewer != nullptr;
            });
            start.picture_s = since(first_success([&] {
                const auto message = viewer->next();
                return message && !message->text;
            }));
        } catch (...) {
            failure = std::current_exception();
        }
    });
    try {
        cluster.up(kServers);
        start.up_s = since(Steady::now());
    } catch (...) {
        failure = std::current_exception();
    }
    looking.join();
    if (failure) std::rethrow_exception(failure);
    return start;
}

}  // namespace

Status bench_compose(Figures& figures, const Effort& effort) {
    if (!test::no_engine().empty()) return fail("{}", test::no_engine());
    std::vector<double> up;
    std::vector<double> page;
    std::vector<double> picture;
    try {
        const test::Image image;
        for (int i = 0; i < effort.repetitions; ++i) {
            const Start start = cold_start(image, effort.smoke ? effort.model : "builtin:knot");
            up.push_back(start.up_s);
            page.push_back(start.page_s);
            picture.push_back(start.picture_s);
        }
    } catch (const std::exception& error) {
        return fail("{}", error.what());
    }
    figures.add("compose_up", up, "s", "");
    figures.add("compose_page", page, "s", "");
    figures.add("compose_first_picture", picture, "s", "at most 5");
    figures.note(
        "from `docker compose up -d` with an image that is built: until it is back, until the page is there, "
        "until a viewer has a picture of a million triangles from four servers");
    return {};
}

}  // namespace swath::bench

#include "tests/bench/race.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <numeric>

#include "common/base/check.h"
#include "tests/bench/figures.h"

namespace swath::bench {

double time_us(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

void Race::add(std::string name, std::function<void()> frame, std::function<Ids()> ids) {
    runners_.push_back({std::move(name), std::move(frame), std::move(ids), {}, {}});
}

void Race::add_work(std::string name, std::function<void()> prepare, std::function<void()> frame) {
    runners_.push_back({std::move(name), std::move(frame), {}, std::move(prepare), {}});
}

void Race::add(std::string name, std::function<std::span<const std::uint32_t>()> frame) {
    const auto last = std::make_shared<std::span<const std::uint32_t>>();
    add(
        std::move(name), [frame = std::move(frame), last] { *last = frame(); },
        [last] { return Ids(last->begin(), last->end()); });
}

Status Race::check(Order order) {
    Ids expected;
    for (const Runner& runner : runners_) {
        if (!runner.ids) continue;
        runner.frame();
        Ids found = runner.ids();
        if (order == Order::kAny) std::sort(found.begin(), found.end());
        if (&runner == &runners_.front()) {
            expected = std::move(found);
            visible_ = expected.size();
        } else if (found != expected) {
            if (order == Order::kSame)
                return fail("{}: '{}' leaves other ids than '{}', or another order", title_, runner.name,
                            runners_.front().name);
            Ids either;
            std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                          std::back_inserter(either));
            return fail("{}: '{}' leaves {} ids, '{}' {}; in one only are {}, the first {}", title_,
                        runner.name, found.size(), runners_.front().name, expected.size(), either.size(),
                        either.at(0));
        }
    }
    return {};
}

void Race::run(int repetitions, int frames, Frames count) {
    for (int i = 0; i < repetitions; ++i)
        for (Runner& runner : runners_) {
            std::vector<double> us;
            for (int k = 0; k < frames; ++k) {
                if (runner.prepare) runner.prepare();
                us.push_back(time_us(runner.frame));
            }
            const double sum = std::accumulate(us.begin(), us.end(), 0.0);
            runner.us.push_back(count == Frames::kBest ? std::ranges::min(us) : sum / frames);
        }
}

const Race::Runner& Race::runner(std::string_view name) const {
    const auto found = std::ranges::find(runners_, name, &Runner::name);
    CHECK(found != runners_.end());
    return *found;
}

double Race::us(std::string_view name) const { return median(runner(name).us); }

std::vector<double> Race::ratios(std::string_view slow, std::string_view fast) const {
    const std::vector<double>& above = runner(slow).us;
    const std::vector<double>& below = runner(fast).us;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
    return ratios;
}

std::string table(const std::string& title, std::span<const Race> races) {
    std::string text = fmt::format("\n{}\n  {:30}", title, "us, times as fast as the first");
    for (const Race& race : races) text += fmt::format(" {:>20}", race.scene_);
    text += fmt::format("\n  {:30}", "visible");
    for (const Race& race : races) text += fmt::format(" {:>20}", race.visible_);
    for (const Race::Runner& runner : races.front().runners_) {
        text += fmt::format("\n  {:30}", runner.name);
        for (const Race& race : races)
            text += fmt::format(" {:>11.1f} {:>8.2f}", race.us(runner.name),
                                median(race.ratios(race.runners_.front().name, runner.name)));
    }
    return text;
}

}  // namespace swath::bench

#include "common/timeline/import.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "common/base/csv.h"
#include "common/timeline/export.h"

namespace swath {
namespace {

constexpr double kMaxMs = 1e10;  // four months, in which a double still tells nanoseconds apart

enum Field : std::size_t { kFrame, kMachine, kKind, kName, kBegin, kEnd, kCpu, kValue };

template <class T>
bool parse_all(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

Result<Nanoseconds> time(std::string_view field, std::string_view text) {
    double ms = 0;
    if (!parse_all(text, ms) || !(std::abs(ms) <= kMaxMs))
        return fail("{}: '{}' is not a time in ms", field, text);
    return Nanoseconds(std::llround(ms * 1e6));
}

class Reader {
  public:
    Status take(const CsvRecord& record) {
        const std::vector<std::string>& fields = record.fields;
        FrameNumber number{};
        if (!parse_all(fields[kFrame], number)) return fail("frame: '{}' is not a number", fields[kFrame]);
        if (fields[kKind] == "frame") return begin_frame(number, fields);
        if (frames_.empty() || frames_.back().frame != number)
            return fail("frame: {} has not begun with a row of kind frame", number);
        if (fields[kMachine].empty()) return fail("machine is empty");
        if (fields[kKind] == "span") return add_span(fields);
        if (fields[kKind] == "counter") return add_count(fields);
        return fail("kind: '{}' is not frame, span or counter", fields[kKind]);
    }

    std::vector<FrameTimeline> frames() { return std::move(frames_); }

  private:
    static Status expect_empty(const std::vector<std::string>& fields, std::initializer_list<Field> empty) {
        for (const Field field : empty)
            if (!fields[field].empty())
                return fail("'{}' where a row of kind {} has nothing", fields[field], fields[kKind]);
        return {};
    }

    Status begin_frame(FrameNumber number, const std::vector<std::string>& fields) {
        SWATH_TRY_VOID(expect_empty(fields, {kMachine, kBegin, kEnd, kCpu}));
        if (fields[kName] != "overlap_factor") return fail("name: '{}' is not overlap_factor", fields[kName]);
        if (!frames_.empty() && number <= frames_.back().frame)
            return fail("frame: {} comes after {}", number, frames_.back().frame);
        FrameTimeline frame{number, {}, 1.0};
        if (!parse_all(fields[kValue], frame.overlap_factor) || !std::isfinite(frame.overlap_factor) ||
            frame.overlap_factor < 0)
            return fail("value: '{}' is not an overlap factor", fields[kValue]);
        frames_.push_back(std::move(frame));
        return {};
    }

    Result<MachineTimeline*> machine(const std::string& name) {
        std::vector<MachineTimeline>& machines = frames_.back().machines;
        if (!machines.empty() && machines.back().machine == name) return &machines.back();
        for (const MachineTimeline& earlier : machines)
            if (earlier.machine == name) return fail("machine: '{}' is there twice in a frame", name);
        return &machines.emplace_back(MachineTimeline{name, {}, {}});
    }

    Status add_span(const std::vector<std::string>& fields) {
        const auto phase = parse<Phase>(fields[kName]);
        if (!phase) return fail("name: '{}' is not a phase", fields[kName]);
        SWATH_TRY(const Nanoseconds begin, time("begin_ms", fields[kBegin]));
        SWATH_TRY(const Nanoseconds end, time("end_ms", fields[kEnd]));
        SWATH_TRY(const Nanoseconds cpu, time("cpu_ms", fields[kCpu]));
        SWATH_TRY_VOID(expect_empty(fields, {kValue}));
        SWATH_TRY(MachineTimeline* const to, machine(fields[kMachine]));
        to->spans.push_back({*phase, begin, end, cpu});
        return {};
    }

    Status add_count(const std::vector<std::string>& fields) {
        const auto counter = parse<Counter>(fields[kName]);
        if (!counter) return fail("name: '{}' is not a counter", fields[kName]);
        SWATH_TRY_VOID(expect_empty(fields, {kBegin, kEnd, kCpu}));
        std::uint64_t count = 0;
        if (!parse_all(fields[kValue], count)) return fail("value: '{}' is not a count", fields[kValue]);
        SWATH_TRY(MachineTimeline* const to, machine(fields[kMachine]));
        (*to)[*counter] = count;
        return {};
    }

    std::vector<FrameTimeline> frames_;
};

}  // namespace

Result<std::vector<FrameTimeline>> parse_timeline(std::string_view csv, std::string_view source) {
    SWATH_TRY(const std::vector<CsvRecord> records, parse_csv(csv, kTimelineHeader, source));
    Reader reader;
    for (std::size_t i = 1; i < records.size(); ++i)
        if (const Status taken = reader.take(records[i]); !taken)
            return fail_in(fmt::format("{}:{}", source, records[i].line), taken.error());
    return reader.frames();
}

}  // namespace swath

#include "tests/bench/plots.h"

#include <map>

#include "common/base/csv.h"
#include "common/base/file.h"

namespace swath::bench {

Status draw_with_csv(const sim::Plot& plot, const std::filesystem::path& stem) {
    std::string csv = csv_field(plot.x_label);
    std::map<double, std::vector<std::string>> rows;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        csv += ',' + csv_field(plot.series[i].name);
        for (const auto& [x, y] : plot.series[i].points) {
            auto& row = rows[x];
            row.resize(plot.series.size());
            row[i] = fmt::format("{:.6g}", y);
        }
    }
    csv += '\n';
    for (const auto& [x, values] : rows) {
        csv += fmt::format("{:.10g}", x);
        for (const std::string& value : values) csv += ',' + value;
        csv += '\n';
    }
    SWATH_TRY_VOID(write_file(stem.string() + ".csv", csv));
    return sim::draw(plot, stem);
}

Status draw_with_csv(const sim::Bars& bars, const std::filesystem::path& stem) {
    std::string csv = csv_field(bars.y_label);
    for (const std::string& segment : bars.segments) csv += ',' + csv_field(segment);
    csv += '\n';
    for (const sim::Bars::Group& group : bars.groups) {
        csv += csv_field(group.name);
        for (std::size_t i = 0; i < bars.segments.size(); ++i)
            csv += fmt::format(",{:.6g}", group.bars.at(i).values.at(i));
        csv += '\n';
    }
    SWATH_TRY_VOID(write_file(stem.string() + ".csv", csv));
    return sim::draw(bars, stem);
}

std::string short_number(std::uint64_t number) {
    if (number < 1000) return std::to_string(number);
    const bool millions = number >= 1'000'000;
    const double value = static_cast<double>(number) / (millions ? 1e6 : 1e3);
    std::string text = value < 10 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text + (millions ? 'M' : 'k');
}

}  // namespace swath::bench

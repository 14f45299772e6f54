#include "client/cost/pricer.h"

#include <algorithm>

namespace swath {
namespace {

double pixels(const Rect& rect) { return static_cast<double>(rect.area()); }

}  // namespace

double Pricer::swath_pixels(const Region& region) const {
    return static_cast<double>(area(region)) * hardware_.network.active_share;
}

double Pricer::sent_of_tile(const Region& region) const {
    return static_cast<double>(area(region)) * hardware_.network.tile_active_share;
}

double Pricer::render_s(double polygons, const Rect& content) const {
    if (polygons <= 0 && content.empty()) return 0;
    return server_.frame_s +
           std::max(polygons * server_.polygon_s, pixels(content) / server_.fill_pixels_per_s);
}

double Pricer::readback_s(const Rect& content) const {
    if (!on_host() || content.empty()) return 0;
    return server_.colour.read_s(pixels(content)) + server_.depth.read_s(pixels(content));
}

double Pricer::send_swath_s(const Region& region) const {
    if (on_host()) return swath_pixels(region) / server_.pack_pixels_per_s;
    double sum_s = 0;
    for (const Rect& rect : region)
        sum_s += server_.colour.read_s(pixels(rect)) + server_.depth.read_s(pixels(rect));
    return sum_s;
}

double Pricer::merge_swath_s(const Region& region) const {
    if (on_host()) return swath_pixels(region) / server_.merge_pixels_per_s;
    double sum_s = 0;
    for (const Rect& rect : region)
        sum_s += server_.colour.write_s(pixels(rect)) + server_.depth.write_s(pixels(rect));
    return sum_s;
}

double Pricer::swath_bytes(const Region& region) const {
    return swath_pixels(region) * hardware_.network.swath_bytes_per_pixel;
}

double Pricer::read_tile_s(const Region& region) const {
    if (on_host())
        return sent_of_tile(region) /
               (server_.gather_pixels_per_s > 0 ? server_.gather_pixels_per_s : server_.pack_pixels_per_s);
    double sum_s = 0;
    for (const Rect& rect : region) sum_s += server_.colour.read_s(pixels(rect));
    return sum_s;
}

double Pricer::display_tile_s(const Region& region) const {
    double sum_s = 0;
    for (const Rect& rect : region) sum_s += hardware_.display.colour.write_s(sent_of_tile({rect}));
    return sum_s;
}

double Pricer::tile_bytes(const Region& region) const {
    return sent_of_tile(region) * hardware_.network.tile_bytes_per_pixel;
}

}  // namespace swath

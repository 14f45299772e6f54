#pragma once
#include "client/cost/hardware.h"
#include "common/geometry/rect.h"

namespace swath {

// Prices the steps of a server's frame on given hardware, in seconds and bytes. With compositing on the
// graphics card every rectangle is an operation of its own on every buffer; in host memory pixels move at a
// rate. Borrows the hardware. Thread-safe.
class Pricer {
  public:
    explicit Pricer(const Hardware& hardware) : hardware_(hardware), server_(hardware.server) {}

    // The longer of polygons and pixels, plus the fixed part of a frame; 0 if there are neither.
    double render_s(double polygons, const Rect& content) const;
    // Host compositing reads the whole content to host memory; on the card this is 0.
    double readback_s(const Rect& content) const;
    double send_swath_s(const Region& region) const;   // the sender's work
    double merge_swath_s(const Region& region) const;  // the receiver's
    double swath_pixels(const Region& region) const;   // active ones, since only those are sent
    double swath_bytes(const Region& region) const;
    double read_tile_s(const Region& region) const;     // the server's work for its tile
    double display_tile_s(const Region& region) const;  // the display's
    double tile_bytes(const Region& region) const;

  private:
    bool on_host() const { return server_.compositing == Compositing::kHost; }
    double sent_of_tile(const Region& region) const;  // pixels

    const Hardware& hardware_;
    const Hardware::Server& server_;
};

}  // namespace swath

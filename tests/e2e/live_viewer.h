#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/web_client.h"

namespace swath::test {

// A viewer without a browser: takes notes, answers pictures, and sends whole wishes. All waits have a limit,
// after which the test fails.
class LiveViewer {
  public:
    using Json = nlohmann::json;

    // `page` is printed by programs: "http://127.0.0.1:8080/".
    explicit LiveViewer(const std::string& page);

    struct Picture {
        Json header;
        std::string file;  // PNG or JPEG
    };

    // Sends the wish with these fields changed and returns its id.
    std::uint64_t wish(const Json& changes);
    void say(const Json& message) { client_->send(message.dump()); }

    // The lossless picture of a stream made from this wish.
    Picture still(std::uint64_t wish, std::uint32_t stream = 0);
    // The first picture for which this is true.
    Picture picture(const std::function<bool(const Picture&)>& right);
    // Waits until the newest note of the type is there and this is true of it.
    Json note(
        const std::string& type,
        const std::function<bool(const Json&)>& right = [](const Json&) { return true; });

    // The wish's camera as a line of a camera file.
    std::string camera_line() const;

  private:
    bool step();  // takes one message

    std::unique_ptr<WebClient> client_;
    Json wish_{{"type", "wish"}, {"id", 0}};
    std::map<std::string, Json> notes_;  // the newest of each type
    std::vector<Picture> pictures_;      // not yet taken
};

}  // namespace swath::test

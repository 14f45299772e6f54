#include "tests/e2e/live_viewer.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "tests/e2e/programs.h"

namespace swath::test {

LiveViewer::LiveViewer(const std::string& page) {
    const std::size_t begin = page.find("http://") + 7;
    const auto address = parse_address(page.substr(begin, page.find('/', begin) - begin));
    if (!address) throw std::runtime_error(page + ": " + address.error().message);
    auto client = WebClient::connect(*address);
    if (!client) throw std::runtime_error(page + ": " + client.error().message);
    client_ = std::move(*client);
}

std::uint64_t LiveViewer::wish(const Json& changes) {
    wish_.update(changes);
    const std::uint64_t id = wish_["id"].get<std::uint64_t>() + 1;
    wish_["id"] = id;
    say(wish_);
    return id;
}

bool LiveViewer::step() {
    const auto message = client_->next(kPatience);
    if (!message) {
        ADD_FAILURE() << "nothing more came";
        return false;
    }
    if (message->text) {
        Json note = Json::parse(message->bytes);
        const std::string type = note["type"];
        notes_[type] = std::move(note);
        return true;
    }
    std::uint32_t head = 0;
    std::memcpy(&head, message->bytes.data(), sizeof head);
    Picture picture{Json::parse(message->bytes.substr(sizeof head, head)),
                    message->bytes.substr(sizeof head + head)};
    say({{"type", "shown"},
         {"frame", picture.header["frame"]},
         {"stream", picture.header["stream"]},
         {"format", picture.header["format"]}});
    pictures_.push_back(std::move(picture));
    return true;
}

LiveViewer::Picture LiveViewer::picture(const std::function<bool(const Picture&)>& right) {
    for (;;) {
        for (std::size_t i = 0; i < pictures_.size(); ++i)
            if (right(pictures_[i])) {
                Picture found = std::move(pictures_[i]);
                pictures_.erase(pictures_.begin() + static_cast<std::ptrdiff_t>(i));
                return found;
            }
        if (!step()) return {};
    }
}

LiveViewer::Picture LiveViewer::still(std::uint64_t wish, std::uint32_t stream) {
    return picture([&](const Picture& p) {
        return p.header["format"] == "png" && p.header["stream"] == stream && p.header["plan"].is_object() &&
               p.header["plan"]["wish"] == wish;
    });
}

LiveViewer::Json LiveViewer::note(const std::string& type, const std::function<bool(const Json&)>& right) {
    for (;;) {
        if (const auto found = notes_.find(type); found != notes_.end() && right(found->second))
            return found->second;
        if (!step()) return {};
    }
}

std::string LiveViewer::camera_line() const {
    std::vector<std::string> numbers;
    for (const Json& number : wish_["camera"]) numbers.push_back(number.dump());
    return fmt::format("{}\n", fmt::join(numbers, " "));
}

}  // namespace swath::test

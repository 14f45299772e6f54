#include "client/machines/discovery.h"

#include <algorithm>
#include <utility>

#include "common/base/file.h"

namespace swath {
namespace asio = boost::asio;
using asio::ip::tcp;
namespace {

constexpr auto kInterval = std::chrono::seconds(1);
constexpr auto kUntilAnswered = std::chrono::milliseconds(100);
constexpr std::uint64_t kMaxFileBytes = 1u << 20;

Result<std::vector<Address>> read_list(const std::string& file) {
    SWATH_TRY(const auto text, read_file(file, kMaxFileBytes));
    auto list = parse_server_list({reinterpret_cast<const char*>(text.data()), text.size()});
    if (!list) return fail("{}: {}", file, list.error().message);
    return list;
}

std::vector<Address> addresses_of(const tcp::resolver::results_type& found) {
    const bool has_v4 = std::any_of(found.begin(), found.end(),
                                    [](const auto& entry) { return entry.endpoint().address().is_v4(); });
    std::vector<Address> addresses;
    for (const auto& entry : found)
        if (entry.endpoint().address().is_v4() == has_v4)
            addresses.push_back({entry.endpoint().address().to_string(), entry.endpoint().port()});
    // The order of a name's addresses means nothing and changes.
    std::sort(addresses.begin(), addresses.end(),
              [](const Address& a, const Address& b) { return to_string(a) < to_string(b); });
    return addresses;
}

}  // namespace

Discovery::Discovery(asio::io_context& io, ServerSource source, OnFound on_found)
    : source_(std::move(source)), on_found_(std::move(on_found)), resolver_(io), timer_(io) {}

void Discovery::ask() {
    switch (source_.kind) {
        case ServerSource::Kind::kList:
            return answer(source_.list);
        case ServerSource::Kind::kFile:
            return answer(read_list(source_.file));
        case ServerSource::Kind::kName:
            break;
    }
    resolver_.async_resolve(
        source_.name.host, std::to_string(source_.name.port), tcp::resolver::numeric_service,
        [this, alive = std::weak_ptr<char>(alive_)](const boost::system::error_code& error,
                                                    const tcp::resolver::results_type& found) {
            if (alive.expired()) return;
            if (error) return answer(fail("{}: {}", source_.name.host, error.message()));
            answer(addresses_of(found));
        });
}

void Discovery::answer(Result<std::vector<Address>> found) {
    std::vector<Address> distinct;
    if (found) {
        for (Address& address : *found)
            if (std::count(distinct.begin(), distinct.end(), address) == 0)
                distinct.push_back(std::move(address));
        *found = std::move(distinct);
    }
    timer_.expires_after(found && !found->empty() ? asio::steady_timer::duration(kInterval)
                                                  : asio::steady_timer::duration(kUntilAnswered));
    timer_.async_wait([this, alive = std::weak_ptr<char>(alive_)](const boost::system::error_code& stopped) {
        if (!stopped && !alive.expired()) ask();
    });
    on_found_(found);  // last, because it may destroy us
}

}  // namespace swath

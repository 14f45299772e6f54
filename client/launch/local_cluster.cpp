#include "client/launch/local_cluster.h"

#include <fcntl.h>

#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <chrono>
#include <thread>

namespace swath {
namespace bp = boost::process;
namespace {
// A program leaves as soon as its lifeline closes. One that is frozen cannot, and is killed after this.
constexpr auto kLeavePatience = std::chrono::milliseconds(300);
}  // namespace

struct LocalCluster::Child {
    std::string name;
    bp::opstream lifeline;
    bp::ipstream output;
    bp::child process;
};

LocalCluster::LocalCluster() = default;
LocalCluster::~LocalCluster() { end(); }

Result<std::unique_ptr<LocalCluster::Child>> LocalCluster::spawn(const std::filesystem::path& program,
                                                                 const std::vector<std::string>& arguments) {
    auto child = std::make_unique<Child>();
    child->name = program.filename().string();
    std::vector<std::string> all{"--listen", "127.0.0.1:0", "--lifeline"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::error_code error;
    // A child that inherited another child's lifeline would keep that child alive.
    for (const int fd : {child->lifeline.pipe().native_source(), child->lifeline.pipe().native_sink(),
                         child->output.pipe().native_source(), child->output.pipe().native_sink()})
        ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    child->process = bp::child(bp::exe = program.string(), bp::args = all,
                               bp::std_in<child->lifeline, bp::std_out> child->output, error);
    if (error) return fail("cannot start {}: {}", program.string(), error.message());
    return child;
}

Result<std::unique_ptr<LocalCluster>> LocalCluster::start(const Options& options) {
    std::unique_ptr<LocalCluster> cluster(new LocalCluster);
    // Starts all before it waits for any.
    for (std::size_t i = 0; i <= options.servers; ++i) {
        std::vector<std::string> arguments = options.arguments;
        const auto& own = i > 0 ? options.server_arguments : options.display_arguments;
        arguments.insert(arguments.end(), own.begin(), own.end());
        SWATH_TRY(auto child,
                  spawn(options.programs / (i == 0 ? "swath-display" : "swath-server"), arguments));
        cluster->children_.push_back(std::move(child));
    }
    for (std::size_t i = 0; i < cluster->children_.size(); ++i) {
        Child& child = *cluster->children_[i];
        std::string line;
        std::getline(child.output, line);
        static constexpr std::string_view kAnnouncement = "listening ";
        if (!line.starts_with(kAnnouncement)) return fail("{} did not start", child.name);
        SWATH_TRY(const auto address, parse_address(std::string_view(line).substr(kAnnouncement.size())));
        if (i == 0)
            cluster->display_ = address;
        else
            cluster->servers_.push_back(address);
    }
    return cluster;
}

void LocalCluster::end() {
    for (const auto& child : children_) child->lifeline.pipe().close();
    const auto deadline = std::chrono::steady_clock::now() + kLeavePatience;
    for (const auto& child : children_) {
        std::error_code ignored;
        while (child->process.running(ignored) && std::chrono::steady_clock::now() < deadline)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        if (child->process.running(ignored)) child->process.terminate(ignored);
        child->process.wait(ignored);
    }
    children_.clear();
}

}  // namespace swath

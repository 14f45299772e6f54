#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/wire/address.h"

namespace swath {

// Runs a display and servers as child processes on loopback, each on a free port. They end with this object,
// and with this process however it ends: each watches its stdin, a pipe from us ("lifeline").
class LocalCluster {
  public:
    struct Options {
        std::filesystem::path programs;  // folder of swath-server and swath-display
        std::size_t servers = 1;
        std::vector<std::string> arguments;  // for every program
        std::vector<std::string> server_arguments;
        std::vector<std::string> display_arguments;
    };
    // Starts all and waits until each has printed its address. Errors name the program and its fault.
    static Result<std::unique_ptr<LocalCluster>> start(const Options& options);
    ~LocalCluster();
    LocalCluster(const LocalCluster&) = delete;
    LocalCluster& operator=(const LocalCluster&) = delete;

    const std::vector<Address>& servers() const { return servers_; }
    const Address& display() const { return display_; }
    void end();

  private:
    struct Child;
    LocalCluster();
    static Result<std::unique_ptr<Child>> spawn(const std::filesystem::path& program,
                                                const std::vector<std::string>& arguments);

    std::vector<std::unique_ptr<Child>> children_;
    std::vector<Address> servers_;
    Address display_;
};

}  // namespace swath

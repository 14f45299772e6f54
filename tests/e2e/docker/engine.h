#pragma once
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/process.h"

namespace swath::test {

using Arguments = std::vector<std::string>;

// The command `docker` and its engine. Every wait has a limit; nothing here is an expectation of a test.

// Empty, or the reason why there is no engine to test with: no command, no answer, or no compose.
const std::string& no_engine();

// Runs `docker ARGUMENTS...`.
Finished docker(const Arguments& arguments, std::chrono::milliseconds limit = std::chrono::seconds(60));
// Runs it and returns standard output without white space around it; throws std::runtime_error when it fails.
std::string docker_says(const Arguments& arguments);
std::vector<std::string> docker_lines(const Arguments& arguments);

// The image under test: $SWATH_IMAGE, or one that is built from docker/Dockerfile under a name of its own. It gets this
// build's package if the image's base is this machine's system; otherwise, and if $SWATH_IMAGE_FROM_SOURCE is set, it
// compiles the working tree.
class Image {
  public:
    // Builds, and shows the builder's output. Throws std::runtime_error when it fails.
    Image();
    // This machine's system with this build's package as /swath_*.deb and nothing else; then `last_lines` of a Dockerfile.
    explicit Image(const std::string& last_lines);
    ~Image();  // removes the image that it built, but not the build cache
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;
    const std::string& name() const { return name_; }

  private:
    std::string name_;
    bool ours_ = false;
};

// A compose project of docker/compose.yaml with a name and a port of its own. It always ends with the object.
class Cluster {
  public:
    struct Options {
        std::string model;
        std::string size;
        std::vector<std::string> files{"compose.yaml"};  // in docker/
    };
    Cluster(const Image& image, const Options& options);
    ~Cluster();
    Cluster(const Cluster&) = delete;
    Cluster& operator=(const Cluster&) = delete;

    // Runs `docker compose ARGUMENTS...`, or docker-compose, on the project.
    Finished compose(const Arguments& arguments,
                     std::chrono::milliseconds limit = std::chrono::seconds(120)) const;
    // Runs `up -d` with this many servers; without `client` only servers and display. Throws when it fails.
    void up(int servers, bool client = true) const;
    void down() const;

    // Running containers of the service.
    std::vector<std::string> running(const std::string& service) const;
    // All containers, networks and volumes of the project.
    std::vector<std::string> left() const;
    std::string logs() const;

    // "127.0.0.1:PORT", at which its page is published.
    const std::string& view() const { return view_; }

  private:
    std::string project_;
    std::string view_;
    std::vector<std::string> environment_;
    Arguments files_;
};

}  // namespace swath::test

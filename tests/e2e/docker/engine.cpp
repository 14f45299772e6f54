#include "tests/e2e/docker/engine.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace swath::test {
namespace {

constexpr std::chrono::minutes kBuilding(15);
const std::string kSource = SWATH_SOURCE_DIR;
const std::string kBuild = SWATH_BUILD_DIR;

Finished run(const Arguments& command, const Process::Options& options, std::chrono::milliseconds limit) {
    return Process("/usr/bin/env", command, options).wait(limit);
}

std::string trimmed(const std::string& text) {
    const auto begin = text.find_first_not_of(" \n");
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \n") - begin + 1);
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (!line.empty()) all.push_back(line);
    return all;
}

[[noreturn]] void fail(const Arguments& command, const Finished& finished) {
    throw std::runtime_error(fmt::format("{} ended with {}: {}{}", fmt::join(command, " "),
                                         finished.exit_code, finished.out, finished.err));
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// Gives the image in which this build's programs run: "debian:bookworm-slim" if the tests run on Debian 12.
std::string own_base() {
    static const std::regex kName("(^|\n)VERSION_CODENAME=(\\w+)");
    const std::string system = text_of("/etc/os-release");
    std::smatch name;
    return std::regex_search(system, name, kName) ? "debian:" + name[2].str() + "-slim" : "";
}

// Shows the builder's own lines, because it may compile, which takes minutes.
void build_image(const std::string& name, const std::filesystem::path& file,
                 const std::filesystem::path& context) {
    const std::string command =
        fmt::format("docker build -f '{}' -t {} '{}'", file.string(), name, context.string());
    std::cout << command << std::endl;
    if (std::system(command.c_str()) != 0) throw std::runtime_error("cannot build " + name);
}

// Builds an image of a Dockerfile with this text, in a folder with nothing but this build's package.
void build_with_package(const std::string& name, const std::string& dockerfile) {
    std::string folder = "/tmp/swath-package-XXXXXX";
    if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no folder for the package");
    const Arguments pack{SWATH_CPACK, "-G", "DEB", "--config", kBuild + "/CPackConfig.cmake", "-B", folder};
    const Finished packed = run(pack, {}, std::chrono::minutes(2));
    if (packed.exit_code != 0) fail(pack, packed);
    std::filesystem::remove_all(folder + "/_CPack_Packages");
    std::ofstream(folder + "/Dockerfile") << dockerfile;
    build_image(name, folder + "/Dockerfile", folder);
    std::filesystem::remove_all(folder);
}

bool succeeds(const Arguments& command) { return run(command, {}, std::chrono::seconds(30)).exit_code == 0; }

// `docker compose` (Compose v2) if it is there, else docker-compose; empty: neither.
const Arguments& compose_command() {
    static const Arguments command = [] {
        for (const Arguments& candidate : {Arguments{"docker", "compose"}, Arguments{"docker-compose"}}) {
            Arguments version = candidate;
            version.emplace_back("version");
            if (succeeds(version)) return candidate;
        }
        return Arguments{};
    }();
    return command;
}

// A port on which nobody listens. Another program could take it first, which fails the test but never makes
// it pass wrongly.
int free_port() {
    const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    const bool bound = ::bind(listener, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
                       ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length) == 0;
    ::close(listener);
    if (!bound) throw std::runtime_error("no free port");
    return ntohs(address.sin_port);
}

}  // namespace

const std::string& no_engine() {
    static const std::string reason = [] {
        if (!succeeds({"docker", "info"})) return "no container engine answers `docker info`";
        if (compose_command().empty()) return "there is neither `docker compose` nor docker-compose";
        return "";
    }();
    return reason;
}

Finished docker(const Arguments& arguments, std::chrono::milliseconds limit) {
    Arguments command{"docker"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(command, {}, limit);
}

std::string docker_says(const Arguments& arguments) {
    const Finished finished = docker(arguments);
    if (finished.exit_code != 0) fail(arguments, finished);
    return trimmed(finished.out);
}

std::vector<std::string> docker_lines(const Arguments& arguments) { return lines(docker_says(arguments)); }

Image::Image() {
    if (const char* given = std::getenv("SWATH_IMAGE"); given != nullptr && *given != '\0') {
        name_ = given;
        return;
    }
    name_ = fmt::format("swath-test:{}", ::getpid());
    const std::string file = text_of(kSource + "/docker/Dockerfile");
    const std::string last_stage = file.substr(file.rfind("\nFROM ") + 1);
    if (std::getenv("SWATH_IMAGE_FROM_SOURCE") != nullptr ||
        !last_stage.starts_with("FROM " + own_base() + "\n"))
        build_image(name_, kSource + "/docker/Dockerfile", kSource);
    else
        build_with_package(name_, "FROM scratch AS build\nCOPY swath_*.deb /swath/build/\n" + last_stage);
    ours_ = true;
}

Image::Image(const std::string& last_lines) {
    name_ = fmt::format("swath-bare-test:{}", ::getpid());
    build_with_package(name_, fmt::format("FROM {}\nCOPY swath_*.deb /\n{}", own_base(), last_lines));
    ours_ = true;
}

Image::~Image() {
    if (ours_) docker({"rmi", "--no-prune", name_});
}

Cluster::Cluster(const Image& image, const Options& options) {
    static int count = 0;
    project_ = fmt::format("swath-test-{}-{}", ::getpid(), count++);
    view_ = fmt::format("127.0.0.1:{}", free_port());
    environment_ = {"COMPOSE_PROJECT_NAME=" + project_, "SWATH_IMAGE=" + image.name(), "SWATH_VIEW=" + view_,
                    "SWATH_MODEL=" + options.model, "SWATH_SIZE=" + options.size};
    for (const std::string& file : options.files) {
        files_.emplace_back("-f");
        files_.push_back(kSource + "/docker/" + file);
    }
}

Cluster::~Cluster() {
    try {
        down();
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
    }
}

Finished Cluster::compose(const Arguments& arguments, std::chrono::milliseconds limit) const {
    Arguments command = compose_command();
    command.insert(command.end(), files_.begin(), files_.end());
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(command, {environment_, kSource + "/docker"}, limit);
}

void Cluster::up(int servers, bool client) const {
    const Arguments arguments{"up",
                              "-d",
                              "--no-build",
                              "--scale",
                              fmt::format("server={}", servers),
                              "--scale",
                              fmt::format("client={}", client ? 1 : 0)};
    const Finished finished = compose(arguments);
    if (finished.exit_code != 0) fail(arguments, finished);
}

void Cluster::down() const {
    const Arguments arguments{"down", "-v"};
    const Finished finished = compose(arguments);
    if (finished.exit_code != 0) fail(arguments, finished);
}

std::vector<std::string> Cluster::running(const std::string& service) const {
    return docker_lines({"ps", "-q", "--no-trunc", "--filter", "label=com.docker.compose.project=" + project_,
                         "--filter", "label=com.docker.compose.service=" + service});
}

std::vector<std::string> Cluster::left() const {
    const std::string filter = "label=com.docker.compose.project=" + project_;
    std::vector<std::string> all = docker_lines({"ps", "-aq", "--filter", filter});
    for (const char* kind : {"network", "volume"})
        for (const std::string& name : docker_lines({kind, "ls", "-q", "--filter", filter}))
            all.push_back(name);
    return all;
}

std::string Cluster::logs() const { return compose({"logs", "--no-color"}).out; }

}  // namespace swath::test

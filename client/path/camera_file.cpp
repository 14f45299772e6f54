#include "client/path/camera_file.h"

#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "common/base/file.h"

namespace swath {
namespace {

constexpr std::size_t kNumbers = std::tuple_size_v<CameraNumbers>;
// Squares of lengths must stay within single precision.
constexpr float kMaxCoordinate = 1e18f;
constexpr std::string_view kBlank = " \t\r";

// Cuts the next word off `line`; empty at the end.
std::string_view next_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlank));
    line.remove_prefix(word.size());
    return word;
}

Result<Camera> parse_camera(std::string_view line) {
    CameraNumbers numbers{};
    std::size_t count = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++count) {
        if (count >= kNumbers) continue;
        // from_chars, unlike strtof, reads a number the same in every locale.
        const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
        float& number = numbers[count];
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error != std::errc{} || end != digits.data() + digits.size())
            return fail("'{}' is not a number", word);
        if (!(std::abs(number) <= kMaxCoordinate))
            return fail("'{}' is not within {:g}", word, kMaxCoordinate);
    }
    if (count != kNumbers)
        return fail("expected {} numbers (eye, target, up, fov_degrees), found {}", kNumbers, count);
    return camera_of(numbers);
}

}  // namespace

Result<Camera> camera_of(const CameraNumbers& numbers) {
    for (const float number : numbers)
        if (!(std::abs(number) <= kMaxCoordinate))
            return fail("{} is not within {:g}", number, kMaxCoordinate);
    Camera camera;
    camera.eye = {numbers[0], numbers[1], numbers[2]};
    camera.target = {numbers[3], numbers[4], numbers[5]};
    camera.up = {numbers[6], numbers[7], numbers[8]};
    if (!(numbers[9] > 0 && numbers[9] < 180))
        return fail("fov_degrees {} is not within (0, 180)", numbers[9]);
    camera.fov_y = glm::radians(numbers[9]);

    const glm::dvec3 sight = glm::dvec3(camera.target) - glm::dvec3(camera.eye);
    const glm::dvec3 up(camera.up);
    // Below this the direction is lost when its squares are summed in single precision.
    if (glm::length(sight) < 1e-15) return fail("eye and target are the same point");
    if (glm::length(up) < 1e-15) return fail("up is zero");
    if (glm::length(glm::cross(glm::normalize(sight), glm::normalize(up))) < 1e-5)
        return fail("up points along the line of sight");
    return camera;
}

CameraNumbers numbers_of(const Camera& camera) {
    return {camera.eye.x,    camera.eye.y, camera.eye.z, camera.target.x, camera.target.y,
            camera.target.z, camera.up.x,  camera.up.y,  camera.up.z,     glm::degrees(camera.fov_y)};
}

std::string to_line(const CameraNumbers& numbers) { return fmt::format("{}", fmt::join(numbers, " ")); }

Result<std::vector<Camera>> parse_cameras(std::string_view text, std::string_view name) {
    std::vector<Camera> cameras;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, length);
        text.remove_prefix(std::min(length + 1, text.size()));
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(kBlank) == std::string_view::npos) continue;
        const Result<Camera> camera = parse_camera(line);
        if (!camera) return fail_in(fmt::format("{}:{}", name, number), camera.error());
        cameras.push_back(*camera);
    }
    if (cameras.empty()) return fail("{}: no cameras", name);
    return cameras;
}

Result<std::vector<Camera>> read_cameras(const std::string& path) {
    SWATH_TRY(const Buffer file, read_file(path, kMaxCameraFileBytes));
    return parse_cameras({reinterpret_cast<const char*>(file.data()), file.size()}, path);
}

}  // namespace swath

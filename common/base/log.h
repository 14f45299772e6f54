#pragma once
#include <fmt/core.h>

#include <string>
#include <utility>

namespace swath {

// The log: lines on stderr with the time, the program and the level. spdlog writes them; it stays in log.cpp, because
// compiling it takes seconds a source.

enum class LogLevel { kInfo, kWarning, kError };

// Lines from now on carry the program's name, and those below `least` are dropped. In main, before other threads.
void start_log(const std::string& program, LogLevel least);

// Any thread.
void log_line(LogLevel level, const std::string& line);

// log_info("model {}: {} triangles", name, triangles);
template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::kInfo, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::kWarning, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace swath

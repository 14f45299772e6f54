// Every command that README.md prints works: all are run, in their order, in a fresh folder in which the
// repository's scripts, the programs and the models lie where a user has them. The rules below say what is not run,
// and what is changed before it is run. A command that they do not know fails the test.
#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <regex>

#include "tests/e2e/programs.h"

namespace swath::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SWATH_SOURCE_DIR;
const fs::path kShell = "/bin/bash";

// Code of the README whose first word is one of these is a command.
const std::regex kCommand("(script/|build/release/bin/swath-|swath-|cd |cmp |echo ).*");
// A block with a line of these is what a program prints.
const std::regex kOutput("ms a frame +partition .*");

// Not run: the command, and why.
struct NotRun {
    std::regex command;
    const char* why;
};
const std::vector<NotRun> kNotRun{
    {std::regex("script/test"), "runs this very test"},
    {std::regex("script/fetch-models"), "needs a network; the models are small stand-ins"},
    {std::regex("cmake --install .*"), "installs for this user; tests/e2e/package installs into a folder"},
    {std::regex("cpack .*"), "tests/e2e/package makes and unpacks the package"},
    {std::regex("sudo apt install .*"), "installs on this machine"},
    {std::regex("cd docker && docker compose up"), "needs a container engine; tests/e2e/docker runs it"},
};

// What is changed, by a regular expression and its replacement, so that the commands fit in a test.
const std::vector<std::pair<std::regex, const char*>> kChanges{
    // A million triangles take minutes.
    {std::regex(R"(^script/run(?= -|$))"), "script/run builtin:knot"},
    {std::regex(R"((builtin:[a-z]+)(?![a-z:]))"), "$1:20000"},
    {std::regex(R"(swath-sim study )"), "$&--frames 2 --seeds 1 "},
    // Another program may have port 8080. A display that runs has been told its port.
    {std::regex(R"(^((?!.*--display).*) --view$)"), "$1 --view 0"},
};

struct Command {
    int line = 0;
    std::string text;     // without comment
    std::string comment;  // of the last line
};
using Block = std::vector<Command>;

// The code blocks with commands.
std::vector<Block> read_commands(const fs::path& readme) {
    std::vector<Block> blocks;
    std::ifstream in(readme);
    bool in_block = false;
    bool is_output = false;
    bool goes_on = false;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        if (!line.starts_with("    ")) {
            if (!line.empty()) in_block = is_output = false;
            continue;
        }
        if (!in_block) blocks.emplace_back();
        in_block = true;
        std::string text = line.substr(line.find_first_not_of(' '));
        std::string comment;
        if (const auto at = text.find("  #"); at != std::string::npos) {
            comment = text.substr(at + 2);
            text.erase(text.find_last_not_of(' ', at) + 1);
        }
        is_output = is_output || std::regex_match(text, kOutput) || text.starts_with("pixel ");
        if (is_output) continue;
        const bool continued = std::exchange(goes_on, text.ends_with('\\'));
        if (goes_on) text.pop_back();
        if (continued)
            blocks.back().back().text += text;
        else
            blocks.back().push_back({number, text, {}});
        blocks.back().back().comment += comment;
    }
    std::erase_if(blocks, [](const Block& block) { return block.empty(); });
    return blocks;
}

class Readme : public EndToEnd {
  protected:
    Readme() {
        fs::create_directories(path("script"));
        fs::create_directories(path("build/release"));
        fs::create_directory_symlink(SWATH_PROGRAMS, path("build/release/bin"));
        for (const char* script : {"run", "common.sh"})
            fs::create_symlink(kSource / "script" / script, path("script") / script);
        // The packages are there and everything is built: this test runs in such a tree.
        for (const char* script : {"bootstrap", "build"}) {
            files_.write(std::string("script/") + script, "#!/bin/sh\n");
            fs::permissions(path("script") / script, fs::perms::owner_all);
        }
        fs::create_directories(path("models"));
        fs::create_directories(path("path/to"));
        files_.write("models/dragon.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
        files_.write("path/to/thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }

    fs::path path(const std::string& name) const { return files_.path_of(name); }

    std::unique_ptr<Process> shell(const std::string& command) const {
        // Nothing else is in the way: the programs are found by their names, as after an installation.
        const std::string search = std::string(SWATH_PROGRAMS) + ":/usr/local/bin:/usr/bin:/bin";
        return std::make_unique<Process>(kShell, Arguments{"-c", command},
                                         Process::Options{{"LP_NUM_THREADS=0", "PATH=" + search,
                                                           "XDG_CACHE_HOME=" + files_.path_of("cache")},
                                                          files_.path_of("")});
    }
    void expect_success(const std::string& command) const {
        const Finished finished = shell(command)->wait(kPatience);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << finished.err << finished.out;
    }
    // A machine "a" of the README is a loopback address that no other run of this test has.
    static std::string address_of(char machine) {
        const int run = ::getpid();
        return fmt::format("127.{}.{}.{}", 1 + run / 250 % 250, 1 + run % 250, machine - 'a' + 1);
    }
    static std::string addressed(std::string command, char machine) {
        command = std::regex_replace(command, std::regex(R"(\b0\.0\.0\.0\b)"), address_of(machine));
        for (char host = 'a'; host <= 'd'; ++host)
            command = std::regex_replace(command, std::regex(fmt::format(R"(\b{}(?=:\d))", host)),
                                         address_of(host));
        return command;
    }
    // "# on machines a, b and c"
    static std::string machines_in(const std::string& comment) {
        std::string machines;
        if (comment.find("# on ") == std::string::npos) return machines;
        const std::regex name(R"(\b[a-d]\b)");
        for (std::sregex_iterator at(comment.begin(), comment.end(), name), end; at != end; ++at)
            machines += at->str();
        return machines;
    }
    // The page that the program prints is there.
    void expect_page(Process& process) const {
        const std::string line = process.wait_for_line("viewer http://", kPatience);
        std::smatch url;
        ASSERT_TRUE(std::regex_search(line, url, std::regex(R"(http://([^:/]+):(\d+)(/\S*))"))) << line;
        expect_success(
            fmt::format("exec 3<>/dev/tcp/{0}/{1} && "
                        "printf 'GET {2} HTTP/1.1\\r\\nHost: {0}:{1}\\r\\n\\r\\n' >&3 && "
                        "read -r status <&3 && [[ $status == 'HTTP/1.1 200 '* ]]",
                        url.str(1), url.str(2), url.str(3)));
    }

    void run(const Command& command) {
        std::string text = command.text;
        for (const auto& [what, with] : kChanges) text = std::regex_replace(text, what, with);
        if (std::regex_search(text, std::regex("^swath-(server|display) "))) {
            const std::string machines = machines_in(command.comment);
            EXPECT_FALSE(machines.empty()) << "the comment does not say on which machines";
            for (const char machine : machines) {
                running_.push_back(shell("exec " + addressed(text, machine)));
                running_.back()->wait_for_line("listening ", kPatience);
            }
            return;
        }
        text = addressed(text, 'a');
        if (std::regex_search(text, std::regex(R"( --view\b)"))) {
            const auto live = shell(text);
            return expect_page(*live);  // then it is ended, with all that it has started
        }
        expect_success(text);
        std::smatch out;
        if (std::regex_search(text, out, std::regex(R"( --out (\S+))"))) {
            EXPECT_TRUE(fs::exists(path(out.str(1)))) << "there is no " << out.str(1);
        }
    }

    std::vector<std::unique_ptr<Process>> running_;
};

TEST_F(Readme, PrintsNoCommandThatDoesNotWork) {
    std::size_t not_run = 0;
    std::size_t ran = 0;
    for (const Block& block : read_commands(kSource / "README.md")) {
        for (const Command& command : block) {
            SCOPED_TRACE(fmt::format("README.md:{}: {}", command.line, command.text));
            if (std::ranges::any_of(kNotRun, [&](const NotRun& rule) {
                    return std::regex_match(command.text, rule.command);
                })) {
                ++not_run;
                continue;
            }
            ASSERT_TRUE(std::regex_match(command.text, kCommand)) << "no rule of this test knows it";
            ASSERT_NO_THROW(run(command));
            ASSERT_FALSE(HasFailure());
            ++ran;
        }
        running_.clear();  // a block's servers serve that block
    }
    EXPECT_EQ(not_run, kNotRun.size()) << "a rule of this test is about nothing";
    EXPECT_GE(ran, 20u);
}

}  // namespace
}  // namespace swath::test

#pragma once
#include <cstddef>
#include <string>

namespace swath {

// Follows the servers through a change of setup, from the message that asks for it to the last answer: all of
// them change, or all go back. Sans-I/O. Not thread-safe.
class SetupChange {
  public:
    enum class Next {
        kWait,    // for more answers
        kDone,    // all have changed
        kGoBack,  // a server refused: ask all for the setup before
        kUndone,  // all have the setup before
        kStuck,   // a server refuses to go back
    };

    // All of so many servers (at least 1) are being asked.
    void begin(std::size_t servers);
    // A server's answer: empty if it has changed, else why not. Only while a change is under way.
    Next on_answer(const std::string& refused);

    bool going_back() const { return going_back_; }
    bool under_way() const { return missing_ > 0; }
    const std::string& why() const { return why_; }  // the first refusal

  private:
    std::size_t servers_ = 0;
    std::size_t missing_ = 0;
    bool going_back_ = false;
    std::string why_;
};

}  // namespace swath

#pragma once

#include "toolbox/carrying.h"
#include "toolbox/clash_list.h"
#include "toolbox/measure.h"
#include "toolbox/proximity.h"
#include "toolbox/viewpoints.h"

#include <array>
#include <exception>
#include <string>
#include <vector>

namespace abut::viewer {

/// Finds parts by their names.
struct Search {
    std::array<char, 128> text{};
    std::vector<std::uint32_t> found;
    std::uint32_t next = 0;
    bool is_over = true;
    bool wants_keyboard = false; ///< the next frame gives the field the keyboard
    bool goes_to_first = false;  ///< as soon as there is a first

    void begin();                   ///< the text has changed
    void proceed(Session& session); ///< compares some more parts
};

/// The panels that can be opened.
enum class Panel : std::uint8_t { none, parts, measure, sections, clashes, carry, viewpoints };

/// The state of all panels.
struct Tools {
    Proximity proximity;
    Measure measure;
    Carrying carrying;
    Viewpoints viewpoints;
    Search search;
    ClashList clashes;
    bool with_help = false, with_panels = true;
    Panel opens = Panel::none;        ///< this panel opens in the next frame
    bool note_wants_keyboard = false; ///< of the clash panel
    bool is_typing = false;           ///< a text field has the keyboard
    bool must_end = false;
    int pictures = 0; ///< written
    double frame_milliseconds = 0;
    std::string message; ///< the last error, or what was done; shown in the status line

    /// Does work, and keeps its error as the message.
    template <typename Work>
    void attempt(const Work& work) {
        try {
            work();
        } catch (const std::exception& error) {
            message = error.what();
        }
    }

    /// Updates the tools in each frame, before it is drawn.
    void update(Session& session, double seconds);
    /// Takes a part out of this walk.
    void remove_part(Session& session, std::uint32_t part);
    /// Adds what the tools show to the marks of the frame.
    void add_marks(Session& session) const;
};

} // namespace abut::viewer

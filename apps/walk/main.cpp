#include <abut/error.h>

#include "arguments.h"
#include "replay.h"
#include "window.h"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    try {
        abut::viewer::Arguments arguments;
        if (!abut::viewer::parse(argc, argv, arguments))
            return 0;
        if (arguments.path.empty())
            abut::viewer::show_window(arguments);
        else
            abut::viewer::replay(arguments);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "abut-walk: %s\n", error.what());
        return 2;
    }
}

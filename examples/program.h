#pragma once

#include <cstdio>
#include <exception>

/// Runs run(argc, argv) as a program. An exception becomes one line on standard error and status 2.
template <typename Run>
int run_program(const char* name, const Run& run, int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return 2;
    }
}

#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "cli/run.h"

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return coppice::run(arguments,
                        {.out = std::cout, .err = std::cerr, .shows_progress = isatty(STDERR_FILENO) == 1});
}

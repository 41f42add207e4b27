// What root is above: permissions of files, and limits on threads.
#pragma once

#include <functional>

namespace coppice::test {

// Runs a test's assertions in a child process that is no root; where one fails, the test does.
void as_plain_user(const std::function<void()>& assertions);

}  // namespace coppice::test

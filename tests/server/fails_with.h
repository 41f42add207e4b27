// EXPECT_THAT([&] { ... }, fails_with(ErrorCode::x, "part of the message"))
#pragma once

#include <gmock/gmock.h>

#include <string>

#include "core/base/error.h"

namespace coppice::test {

MATCHER_P2(fails_with, code, message_part,
           std::string("fails with ") + std::string(name(code)) + ": ..." + message_part) {
    try {
        arg();
    } catch (const Error& error) {
        *result_listener << name(error.code()) << ": " << error.message();
        return error.code() == code && error.message().find(message_part) != std::string::npos;
    }
    *result_listener << "nothing was thrown";
    return false;
}

}  // namespace coppice::test

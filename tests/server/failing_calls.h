// System calls of this process that fail when a test says so, as they do where descriptors run out or a disk
// is full: an executable's own definitions come before those of libc.
#pragma once

namespace coppice::test {

// While it lives, and no others of its kind do, the next `times` calls fail with this errno.
class FailingCalls {
  public:
    enum class Call { accept4, fsync };

    FailingCalls(Call call, int error, int times = 1);
    ~FailingCalls();
    FailingCalls(const FailingCalls&) = delete;
    FailingCalls& operator=(const FailingCalls&) = delete;

    int left() const;  // calls that have still to come

  private:
    Call call_;
};

}  // namespace coppice::test

#include "wheelwright/base/process_settings.h"

#include <gtest/gtest.h>

extern "C" {
void openblas_set_num_threads(int);
int openblas_get_num_threads();
}

namespace wheelwright {
namespace {

/// As a program with another use of BLAS has it.
class BlasOfAnotherProgram : public ::testing::Test {
 protected:
  BlasOfAnotherProgram() { openblas_set_num_threads(2); }
  ~BlasOfAnotherProgram() override { openblas_set_num_threads(before_); }

 private:
  int before_ = openblas_get_num_threads();
};

TEST_F(BlasOfAnotherProgram, HasOneThreadForAsLongAsAnyoneWantsIt) {
  {
    const OneBlasThread one;
    EXPECT_EQ(openblas_get_num_threads(), 1);
    { const OneBlasThread another; }
    EXPECT_EQ(openblas_get_num_threads(), 1);
    EXPECT_EQ(blas_settings().threads, 1);
  }
  EXPECT_EQ(openblas_get_num_threads(), 2);
  EXPECT_FALSE(blas_settings().kernels.empty());
}

}  // namespace
}  // namespace wheelwright

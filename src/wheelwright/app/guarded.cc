#include "wheelwright/app/guarded.h"

#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/files/output_error.h"

namespace wheelwright {

int guarded(const std::string& who, const std::function<int()>& work) {
  try {
    return work();
  } catch (const OutputError& error) {
    print_err("{}: {}\n", who, error.what());
    return exit_input_output;
  } catch (const std::filesystem::filesystem_error& error) {
    print_err("{}: {}: {}; check the name and the permissions\n", who, error.path1().string(),
              error.code().message());
    return exit_input_output;
  } catch (const std::system_error& error) {
    print_err("{}: system error: {}\n", who, error.code().message());
    return exit_input_output;
  } catch (const std::bad_alloc&) {
    print_err("{}: out of memory; use fewer cells or load positions\n", who);
    return exit_refused;
  } catch (const std::exception& error) {
    print_err("{}: bug: {}\n", who, error.what());
    return exit_bug;
  }
}

}  // namespace wheelwright

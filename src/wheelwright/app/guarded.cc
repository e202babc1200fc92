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
    tell("{}: {}\n", who, error.what());
    return exit_input_output;
  } catch (const std::filesystem::filesystem_error& error) {
    tell("{}: {}: {}; check the name and the permissions\n", who, error.path1().string(),
         error.code().message());
    return exit_input_output;
  } catch (const std::system_error& error) {
    tell("{}: the system refuses: {}\n", who, error.code().message());
    return exit_input_output;
  } catch (const std::bad_alloc&) {
    tell("{}: the memory is used up; take fewer cells or load positions\n", who);
    return exit_refused;
  } catch (const std::exception& error) {
    tell("{}: bug: {}\n", who, error.what());
    return exit_bug;
  }
}

}  // namespace wheelwright

# cmake -D SOURCE=FOLDER -D OUT=commit.cpp -P WriteCommit.cmake: writes the commit of the checkout in FOLDER into the
# definition of CommitOfBuild() (apps/version.h), with a "+" behind it where files differ from it. In what `git archive`
# made, git has put the commit into commit.txt. Without either it is empty. OUT is touched only where it changes.

cmake_minimum_required(VERSION 3.25)

file(READ "${SOURCE}/cmake/commit.txt" commit)
string(STRIP "${commit}" commit)
if(NOT commit MATCHES "^[0-9a-f]+$")
  set(commit "")
  find_program(GIT git)
  if(GIT AND EXISTS "${SOURCE}/.git")
    # Whoever builds need not be the owner of the checkout.
    execute_process(COMMAND "${GIT}" -c "safe.directory=*" -C "${SOURCE}" describe --always --dirty=+ --exclude "*"
                    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
file(CONFIGURE OUTPUT "${OUT}" @ONLY CONTENT "#include \"apps/version.h\"

const char* penumbra::CommitOfBuild() { return \"@commit@\"; }
")

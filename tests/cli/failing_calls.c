/* Lets one call that changes a file fail: preloaded (LD_PRELOAD), it stands between a program and the system. Calls on files
   below the directory FAIL_UNDER are counted and logged to the file FAIL_LOG, one line each: number, name, path. The call
   with the number FAIL_AT fails (0: none), with FAIL_ON all behind it, too. What writes fails like a full disk, after half
   of its bytes; other calls like a broken one. A close that fails has closed. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static int counted;

static int below(const char* path) {
  const char* under = getenv("FAIL_UNDER");
  return under != NULL && path != NULL && strncmp(path, under, strlen(under)) == 0;
}

/* Whether a call on this path is to fail. */
static int fails(const char* name, const char* path) {
  if (!below(path)) return 0;
  const int number = __atomic_add_fetch(&counted, 1, __ATOMIC_SEQ_CST), saved = errno;
  char line[4352];
  const int length = snprintf(line, sizeof line, "%d %s %s\n", number, name, path);
  const char* log = getenv("FAIL_LOG");
  const long file = log == NULL ? -1 : syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND, 0666);
  if (file >= 0) {
    syscall(SYS_write, file, line, (size_t)length);
    syscall(SYS_close, file);
  }
  errno = saved;
  const char* at = getenv("FAIL_AT");
  const int chosen = at == NULL ? 0 : atoi(at);
  return chosen > 0 && (number == chosen || (number > chosen && getenv("FAIL_ON") != NULL));
}

static int fails_on(const char* name, int file) {
  char place[64], path[4096];
  snprintf(place, sizeof place, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(place, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = '\0';
  return fails(name, path);
}

static int error(int number) {
  errno = number;
  return -1;
}

#define NEXT(type, name) ((type)dlsym(RTLD_NEXT, name))

ssize_t write(int file, const void* data, size_t size) {
  const int bad = fails_on("write", file);
  const ssize_t done = syscall(SYS_write, file, data, bad ? size / 2 : size);
  return bad ? error(ENOSPC) : done;
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t place) {
  const int bad = fails_on("pwrite", file);
  const ssize_t done = syscall(SYS_pwrite64, file, data, bad ? size / 2 : size, place);
  return bad ? error(ENOSPC) : done;
}
ssize_t pwrite(int file, const void* data, size_t size, off_t place) { return pwrite64(file, data, size, place); }

ssize_t writev(int file, const struct iovec* parts, int count) {
  return fails_on("writev", file) ? error(ENOSPC) : syscall(SYS_writev, file, parts, count);
}

ssize_t pwritev(int file, const struct iovec* parts, int count, off_t place) {
  if (fails_on("pwritev", file)) return error(ENOSPC);
  return NEXT(ssize_t(*)(int, const struct iovec*, int, off_t), "pwritev")(file, parts, count, place);
}

int posix_fallocate(int file, off_t place, off_t size) {
  if (fails_on("fallocate", file)) return ENOSPC;
  return NEXT(int (*)(int, off_t, off_t), "posix_fallocate")(file, place, size);
}

int ftruncate(int file, off_t size) {
  return fails_on("ftruncate", file) ? error(EIO) : (int)syscall(SYS_ftruncate, file, size);
}

int fsync(int file) { return fails_on("fsync", file) ? error(EIO) : 0; }  /* no test cuts the power */

int close(int file) {
  const int bad = fails_on("close", file), done = (int)syscall(SYS_close, file);
  return bad ? error(EIO) : done;
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(list, int) : 0;
  va_end(list);
  if ((flags & O_ACCMODE) != O_RDONLY && fails("open", path)) return error(ENOSPC);
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int mkdir(const char* path, mode_t mode) {
  return fails("mkdir", path) ? error(ENOSPC) : (int)syscall(SYS_mkdirat, AT_FDCWD, path, mode);
}

int rename(const char* from, const char* to) {
  if (fails("rename", to)) return error(EIO);
  return NEXT(int (*)(const char*, const char*), "rename")(from, to);
}

int link(const char* from, const char* to) {
  if (fails("link", to)) return error(EIO);
  return NEXT(int (*)(const char*, const char*), "link")(from, to);
}

int unlink(const char* path) {
  if (fails("unlink", path)) return error(EIO);
  return NEXT(int (*)(const char*), "unlink")(path);
}

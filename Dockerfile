# docker build -t polybed . ; then, in the folder of a case:
# docker run --rm -v "$PWD:/bed" polybed tfm case.toml
# tests/packaging/container_test.py does both.
FROM debian:12 AS build
# Debian's packages to compile, and those of the documentation, which the package contains.
COPY cmake/packages.txt /
RUN apt-get update \
    && apt-get install -y --no-install-recommends $(cat /packages.txt) dpkg-dev file python3-sphinx python3-myst-parser furo libjs-mathjax
COPY . /polybed
WORKDIR /polybed
RUN cmake --preset release -DPOLYBED_TESTS=OFF && cd build && cpack

FROM debian:12
COPY --from=build /polybed/build/*.deb /polybed.deb
RUN apt-get update \
    && apt-get install -y --no-install-recommends /polybed.deb \
    && rm -rf /polybed.deb /var/lib/apt/lists/*
WORKDIR /bed
# For the caches of matplotlib and of polybed estimate.
ENV HOME=/tmp
# Root becomes the owner of the folder, so that the runs belong to the user and not to root.
ENTRYPOINT ["sh", "-c", "as=; [ $(id -u) != 0 ] || as=\"setpriv --reuid $(stat -c %u .) --regid $(stat -c %g .) --clear-groups\"; exec $as polybed \"$@\"", "polybed"]

"""The key by which an LMS knows this program: the private part stays, the public goes there."""

import os

from slamlab.grading.term.course_file import TermError

KEY_BITS = 2048


class LtiError(TermError):
    """The LMS's services cannot be used; the text says why."""


def library():
    """The libraries of the extra: authlib's client and assertions, joserfc's keys."""
    try:
        import authlib.integrations.requests_client as client
        from authlib.oauth2 import rfc7523
        from joserfc import jwk
    except ImportError:
        raise LtiError('LTI needs more libraries: pip install "slamlab[lti]"') from None
    return client, rfc7523, jwk


def load_key(file, make=False):
    """Load the private key that assertions are signed by.

    Parameters
    ----------
    file : Path, PEM
    make : bool, whether to make one where there is none, readable by its owner only

    Returns
    -------
    joserfc's RSAKey

    Raises
    ------
    LtiError
    """
    *_, jwk = library()
    from joserfc.errors import JoseError

    try:
        if make and not file.exists():
            made = jwk.RSAKey.generate_key(KEY_BITS)
            handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(handle, "wb") as stream:
                stream.write(made.as_pem(private=True))
        found = jwk.RSAKey.import_key(file.read_bytes())
        if not found.is_private:
            raise LtiError(f"{file} is a public key; the private one is needed")
        return found
    except OSError as error:
        said = f"{error.strerror}; slamlab grade lti key makes one"
        raise LtiError(f"the key {file} cannot be read: {said}") from None
    except (JoseError, ValueError, TypeError) as error:
        raise LtiError(f"{file} is no RSA key in PEM: {error}") from None


def public_key(key):
    """The public part, for the LMS.

    Parameters
    ----------
    key : RSAKey, of :func:`load_key`

    Returns
    -------
    dict, the JWK
    str, PEM
    """
    told = {"use": "sig", "alg": "RS256", "kid": key.thumbprint()}
    return key.as_dict(private=False) | told, key.as_pem(private=False).decode()

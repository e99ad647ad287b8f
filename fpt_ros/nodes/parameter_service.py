"""The services of parameters; rclpy leaves a call with a type that there is not unanswered."""

from collections.abc import Sequence

from rcl_interfaces.msg import Parameter, SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter as RosParameter
from rclpy.parameter_service import ParameterService


class AnsweringParameterService(ParameterService):
    """rclpy's, which refuses what it cannot read: who asked would wait for ever."""

    def _set_parameters_callback(
        self, request: SetParameters.Request, response: SetParameters.Response
    ) -> SetParameters.Response:
        for each in request.parameters:
            refused = _refused([each])
            if refused is None:
                one = SetParameters.Request(parameters=[each])
                super()._set_parameters_callback(one, response)
            else:
                response.results.append(refused)
        return response

    def _set_parameters_atomically_callback(
        self, request: SetParametersAtomically.Request, response: SetParametersAtomically.Response
    ) -> SetParametersAtomically.Response:
        refused = _refused(request.parameters)
        if refused is None:
            return super()._set_parameters_atomically_callback(request, response)
        response.result = refused
        return response


def _refused(parameters: Sequence[Parameter]) -> SetParametersResult | None:
    """Why these cannot be read; ``None``: they can."""
    for each in parameters:
        try:
            RosParameter.from_parameter_msg(each)
        except ValueError as error:
            reason = f"{each.name}: a value that cannot be read: {error}"
            return SetParametersResult(successful=False, reason=reason)
    return None
